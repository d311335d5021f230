
use builtin;
use str;

set edit:completion:arg-completer[lumbre] = {|@words|
    fn spaces {|n|
        builtin:repeat $n ' ' | str:join ''
    }
    fn cand {|text desc|
        edit:complex-candidate $text &display=$text' '(spaces (- 14 (wcswidth $text)))$desc
    }
    var command = 'lumbre'
    for word $words[1..-1] {
        if (str:has-prefix $word '-') {
            break
        }
        set command = $command';'$word
    }
    var completions = [
        &'lumbre'= {
            cand -h 'Print help'
            cand --help 'Print help'
            cand -V 'Print version'
            cand --version 'Print version'
            cand render 'Render a scene to a picture'
            cand view 'Look at a scene in a window, walk through it and change it'
            cand info 'Say what a scene holds, what it takes, and why its picture might be black'
            cand compare 'Measure how much a picture differs from a reference'
            cand merge 'Add parts of one render, made apart, to the picture of one run'
            cand devices 'List what can render here: the CPU, and every GPU that Vulkan finds, with what it lacks'
            cand bench 'Measure frames per second, rays per second and their like, as tables'
            cand completions 'Print what makes a shell complete the flags of this program'
            cand man 'Print the manual page, or write one for each command'
            cand help 'Print this message or the help of the given subcommand(s)'
        }
        &'lumbre;render'= {
            cand -o 'File to write: .png, .jpg (8 bits a band, for display), .hdr (linear radiance) or .exr (linear, 32-bit floats, with layers); - is standard output, a PNG, or of another format as exr:-. May be given several times. [default: the scene''s name with .png, beside it or in this folder; never a file that is there already]'
            cand --output 'File to write: .png, .jpg (8 bits a band, for display), .hdr (linear radiance) or .exr (linear, 32-bit floats, with layers); - is standard output, a PNG, or of another format as exr:-. May be given several times. [default: the scene''s name with .png, beside it or in this folder; never a file that is there already]'
            cand --size 'Columns and rows of the picture, up to 32768 each. [default: 720 rows in the shape that the camera was framed for, 1280x720 where the scene does not say]'
            cand --background 'What the camera sees behind the scene. What is left out still gives light. [default: scene]'
            cand --first-sample 'Number of the first sample of each pixel. A render can be split: each part takes --spp samples from here, its .exr carries the exact sums, and `lumbre merge` adds them to the bits of one run'
            cand --exposure 'Brightness: `auto` makes the log-average luminance middle grey (0.18), `thesis` is 0.5 over the average clamped to 0.1..1, a number is stops: each one more doubles. [default: auto]'
            cand --tone 'Tone curve: `srgb` and `linear` (gamma 2.2) clip what is brighter than white; `reinhard`, `aces` and `agx` roll it off, and so does `neutral`, which keeps the colours of materials. [default: srgb]'
            cand --vignette 'Darkens towards the corners, which keep 1 - X of their light; 0 to 1. [default: 0]'
            cand --aberration 'Chromatic aberration: enlarges red about the centre by X per cent and makes blue smaller by as much; -50 to 50. [default: 0]'
            cand --quality 'Quality of a JPEG'
            cand --mode 'How the picture is drawn'
            cand --camera-path 'Moves the camera along a way, a line for each place: eye X,Y,Z, what it looks at X,Y,Z, degrees of view if they change. --frames pictures are written, numbered: NAME-0001.png and so on'
            cand --frames 'With --camera-path: pictures on the way [default: 60]. Else of a hybrid picture: frames before it is written, over which light and edges are gathered [default: 32, or 1 where nothing is]'
            cand --hybrid 'What frames have, where the flags below do not say it'
            cand --soft-shadows 'Penumbras of lamps and sun where the camera sees them. [default: that of --hybrid]'
            cand --ambient-occlusion 'Ambient light stays away from where things meet; without light between surfaces. [default: off]'
            cand --global-illumination 'Light that sky and surfaces throw on what the camera sees, one ray a pixel. [default: that of --hybrid]'
            cand --light-filter 'Filters the noise of all of these over space and time. [default: that of --hybrid]'
            cand --anti-aliasing 'How edges are made smooth. [default: fxaa for `thesis`, temporal for `all`]'
            cand --render-scale 'Rows and columns that are drawn over those that are shown, 0.5 to 1; with temporal anti-aliasing. [default: 1]'
            cand --planes 'Writes what the last frame knows of its pixels into this folder, a PNG each: normal, depth, position, albedo, roughness, specularity, mirrored, through, index, emission, object, material, motion, sharp, soft, gathered, filtered'
            cand --ambient 'Radiance that stands for light that no ray brings, nits. [default: found from sky and lamps]'
            cand --spp 'Samples per pixel. [default: 4096 if neither --time nor --target-error is given either]'
            cand --time 'Time for the whole command but the writing of the picture, such as 30s, 1.5min, 1h30min. [default: 10min if neither --spp nor --target-error is given either]'
            cand --target-error 'Stop when the picture is this good: the estimated relMSE that `lumbre compare` would find against a perfect one. 0.02 is grainy, 0.005 shows some grain, 0.001 none. 64 samples are taken at least. [default: 0.002 if neither --spp nor --time is given either]'
            cand --save-every 'Write the outputs again and again with what there is so far, this far apart'
            cand --max-depth 'Most scattering events on a path. [default: 16]'
            cand --rough-bounces 'How often surfaces that are no mirrors or clear glass may throw light on others: 0 leaves direct light, 1 adds what arrives by one such surface. [default: unlimited]'
            cand --roulette 'First scattering event after which Russian roulette may end a path. [default: 4]'
            cand --sampler 'Random stream. [default: sobol]'
            cand --seed 'Seed of the random stream: another one gives other noise. [default: 0]'
            cand --filter 'Pixel filter. [default: blackman-harris]'
            cand --light-sampling 'Aim rays at the lights (next-event estimation); off: lights are found by chance, and point lights never. [default: on]'
            cand --transmissive-shadows 'What shadow rays do at smooth solid glass and water; thin panes always let light through with their tint. [default: auto]'
            cand --back-faces 'Whether camera rays see the back of single-sided opaque surfaces. [default: cull]'
            cand --clamp 'Most that light which has scattered twice or more may add to a sample at a time, nits (biased: it takes bright dots away, and light with them). [default: no limit]'
            cand --hemisphere 'How diffuse directions are drawn (for comparisons). [default: cosine]'
            cand --camera 'Which of the scene''s cameras: its name, that of its node, or its number from 0. [default: the first; the whole scene in view if there is none]'
            cand --look-from 'Puts the eye here, metres'
            cand --look-at 'Turns the camera to this point, metres'
            cand --fov 'Vertical field of view, degrees. An orthographic camera becomes a perspective one'
            cand --aperture 'Opens the lens, so that only what is in focus is sharp: `f/2.8` as on a camera with a sensor 24 mm high, or the diameter of the lens in metres. [default: everything is sharp]'
            cand --focus 'What is in focus: a distance in metres along the direction of view, or `auto`, what lies in the centre of the picture. [default: auto]'
            cand --crop 'Renders only this part of the picture: column and row of its top left pixel, columns and rows. Its pixels are those of the whole picture, to the bit'
            cand --sky 'What fills the sky: one radiance (R,G,B linear in nits, or #rrggbb sRGB), a plain `gradient` with a mean near 1, or nothing. [default: what the scene has; the gradient if nothing in it gives light]'
            cand --sun 'A sun: elevation above the horizon and azimuth from -z towards +x, degrees. STRENGTH is the illuminance on a surface that faces it, in lux on the scale of the scene''s lights; 15 by default, which makes a clear day with the gradient sky (a real clear noon is 100000 lux under a sky of some 5000 nits). Its light is slightly warm'
            cand --env 'A latitude-longitude picture of radiance around the scene: .hdr or .exr. Its centre lies at -z'
            cand --env-rotate 'Turns that picture to the right as seen from inside, degrees'
            cand --env-strength 'Factor on its radiance'
            cand --device 'Where to render: `auto`, the best GPU that traces rays, or the CPU where there is none or it fails; `cpu`; `gpu`, the best GPU or an error; `gpu:N`, or the name of a GPU or a part of it. `lumbre devices` lists them'
            cand --threads 'Threads. [default: one for each processor]'
            cand --memory-limit 'Refuse a picture that takes more memory than this: bytes, or with K, M, G or T, powers of 1024. [default: what the system has]'
            cand --progress 'How to show progress'
            cand --pixel 'Instead of a picture, trace one camera sample of this pixel (column, row, from the top left) and print each step on stdout. All other flags must be those of the picture'
            cand --sample 'Which sample of that pixel, from 0'
            cand --scene 'Which of the file''s scenes: its name, or its number from 0. [default: the one that the file names, else the first]'
            cand --variant 'Which of the file''s sets of materials, by name. [default: the materials that stand without one]'
            cand --edits 'What was changed of the scene, as `lumbre view` writes it (docs/edits.md says what can stand there): camera, lights, materials, places of things, settings, look. Flags that are given stand above it'
            cand --asset-dir 'Folder from which textures and other files that the scene names may be read too. May be given several times'
            cand --max-file-bytes 'Bytes of one file, such as 4GiB. [default: 8GiB]'
            cand --max-json-bytes 'Bytes of a scene''s JSON. [default: 256MiB]'
            cand --max-json-objects 'Objects in a scene''s JSON, of all kinds together. [default: 4194304]'
            cand --max-json-depth 'Lists and objects of a scene''s JSON inside one another, up to 127. [default: 64]'
            cand --max-buffer-bytes 'Bytes of all buffers of a scene; also of all its encoded images. [default: 16GiB]'
            cand --max-image-side 'Columns or rows of an image. [default: 32768]'
            cand --max-image-bytes 'Bytes of one image once decoded. [default: 4GiB]'
            cand --max-total-image-bytes 'Bytes of all images of a scene once decoded. [default: 16GiB]'
            cand --max-triangles 'Triangles, each mesh counted once. [default: 500000000]'
            cand --max-vertices 'Vertices, each mesh counted once. [default: 500000000]'
            cand --max-zero-filled 'Elements of a glTF accessor that has no data of its own. [default: 1048576]'
            cand --max-instances 'Meshes that the nodes place in the world. [default: 16777216]'
            cand --max-node-depth 'Nodes beneath one another. [default: 1048576]'
            cand --keep-sums 'An .exr carries the exact sums of its samples (about 150 bytes a pixel before compression), so that `lumbre merge` can add more; --first-sample implies it'
            cand --validation 'Lets Vulkan''s validation layer, where it is installed, look over every call of a GPU: slow, for those who change this program'
            cand --stats 'At the end, say in a table what took how much time and memory; with --progress json as part of the last line'
            cand -h 'Print help (see more with ''--help'')'
            cand --help 'Print help (see more with ''--help'')'
        }
        &'lumbre;view'= {
            cand --size 'Size of the window, in the points of the display. [default: 1280x800]'
            cand --report 'Writes what the window does to a file, a line of JSON for each step: how long it took, what it shows, and where the controls are, for programs that drive it'
            cand --device 'Where to render: `auto`, the best GPU that traces rays, or the CPU where there is none or it fails; `cpu`; `gpu`, the best GPU or an error; `gpu:N`, or the name of a GPU or a part of it. `lumbre devices` lists them'
            cand --threads 'Threads. [default: one for each processor]'
            cand --scene 'Which of the file''s scenes: its name, or its number from 0. [default: the one that the file names, else the first]'
            cand --variant 'Which of the file''s sets of materials, by name. [default: the materials that stand without one]'
            cand --edits 'What was changed of the scene, as `lumbre view` writes it (docs/edits.md says what can stand there): camera, lights, materials, places of things, settings, look. Flags that are given stand above it'
            cand --asset-dir 'Folder from which textures and other files that the scene names may be read too. May be given several times'
            cand --max-file-bytes 'Bytes of one file, such as 4GiB. [default: 8GiB]'
            cand --max-json-bytes 'Bytes of a scene''s JSON. [default: 256MiB]'
            cand --max-json-objects 'Objects in a scene''s JSON, of all kinds together. [default: 4194304]'
            cand --max-json-depth 'Lists and objects of a scene''s JSON inside one another, up to 127. [default: 64]'
            cand --max-buffer-bytes 'Bytes of all buffers of a scene; also of all its encoded images. [default: 16GiB]'
            cand --max-image-side 'Columns or rows of an image. [default: 32768]'
            cand --max-image-bytes 'Bytes of one image once decoded. [default: 4GiB]'
            cand --max-total-image-bytes 'Bytes of all images of a scene once decoded. [default: 16GiB]'
            cand --max-triangles 'Triangles, each mesh counted once. [default: 500000000]'
            cand --max-vertices 'Vertices, each mesh counted once. [default: 500000000]'
            cand --max-zero-filled 'Elements of a glTF accessor that has no data of its own. [default: 1048576]'
            cand --max-instances 'Meshes that the nodes place in the world. [default: 16777216]'
            cand --max-node-depth 'Nodes beneath one another. [default: 1048576]'
            cand --watch 'Opens the scene again when its file changes'
            cand --validation 'Lets Vulkan''s validation layer, where it is installed, look over every call of a GPU: slow, for those who change this program'
            cand -h 'Print help (see more with ''--help'')'
            cand --help 'Print help (see more with ''--help'')'
        }
        &'lumbre;info'= {
            cand --size 'Size of the picture whose memory is predicted'
            cand --scene 'Which of the file''s scenes: its name, or its number from 0. [default: the one that the file names, else the first]'
            cand --variant 'Which of the file''s sets of materials, by name. [default: the materials that stand without one]'
            cand --edits 'What was changed of the scene, as `lumbre view` writes it (docs/edits.md says what can stand there): camera, lights, materials, places of things, settings, look. Flags that are given stand above it'
            cand --asset-dir 'Folder from which textures and other files that the scene names may be read too. May be given several times'
            cand --max-file-bytes 'Bytes of one file, such as 4GiB. [default: 8GiB]'
            cand --max-json-bytes 'Bytes of a scene''s JSON. [default: 256MiB]'
            cand --max-json-objects 'Objects in a scene''s JSON, of all kinds together. [default: 4194304]'
            cand --max-json-depth 'Lists and objects of a scene''s JSON inside one another, up to 127. [default: 64]'
            cand --max-buffer-bytes 'Bytes of all buffers of a scene; also of all its encoded images. [default: 16GiB]'
            cand --max-image-side 'Columns or rows of an image. [default: 32768]'
            cand --max-image-bytes 'Bytes of one image once decoded. [default: 4GiB]'
            cand --max-total-image-bytes 'Bytes of all images of a scene once decoded. [default: 16GiB]'
            cand --max-triangles 'Triangles, each mesh counted once. [default: 500000000]'
            cand --max-vertices 'Vertices, each mesh counted once. [default: 500000000]'
            cand --max-zero-filled 'Elements of a glTF accessor that has no data of its own. [default: 1048576]'
            cand --max-instances 'Meshes that the nodes place in the world. [default: 16777216]'
            cand --max-node-depth 'Nodes beneath one another. [default: 1048576]'
            cand --json 'Prints one JSON object; lengths in metres, angles in radians, memory in bytes'
            cand -h 'Print help (see more with ''--help'')'
            cand --help 'Print help (see more with ''--help'')'
        }
        &'lumbre;compare'= {
            cand -o 'Writes where they differ (the FLIP map in magma colours; of HDR-FLIP if there is one)'
            cand --output 'Writes where they differ (the FLIP map in magma colours; of HDR-FLIP if there is one)'
            cand --fail-above 'Exits with code 1 if the figure is above this value: rmse, relmse, ldr-flip, hdr-flip, or non-finite (the number of pixels of TEST alone that are no numbers, 0 unless given). May be given several times'
            cand --layer 'Layer of both EXR files, instead of the picture itself'
            cand --exposure 'Brightness at which HDR pictures are shown, as in `lumbre render`'
            cand --json 'Prints one JSON object; an infinite PSNR is null'
            cand -h 'Print help'
            cand --help 'Print help'
        }
        &'lumbre;merge'= {
            cand --exposure 'Brightness: `auto` makes the log-average luminance middle grey (0.18), `thesis` is 0.5 over the average clamped to 0.1..1, a number is stops: each one more doubles. [default: auto]'
            cand --tone 'Tone curve: `srgb` and `linear` (gamma 2.2) clip what is brighter than white; `reinhard`, `aces` and `agx` roll it off, and so does `neutral`, which keeps the colours of materials. [default: srgb]'
            cand --vignette 'Darkens towards the corners, which keep 1 - X of their light; 0 to 1. [default: 0]'
            cand --aberration 'Chromatic aberration: enlarges red about the centre by X per cent and makes blue smaller by as much; -50 to 50. [default: 0]'
            cand --quality 'Quality of a JPEG'
            cand --max-file-bytes 'Bytes of one file, such as 4GiB. [default: 8GiB]'
            cand --max-json-bytes 'Bytes of a scene''s JSON. [default: 256MiB]'
            cand --max-json-objects 'Objects in a scene''s JSON, of all kinds together. [default: 4194304]'
            cand --max-json-depth 'Lists and objects of a scene''s JSON inside one another, up to 127. [default: 64]'
            cand --max-buffer-bytes 'Bytes of all buffers of a scene; also of all its encoded images. [default: 16GiB]'
            cand --max-image-side 'Columns or rows of an image. [default: 32768]'
            cand --max-image-bytes 'Bytes of one image once decoded. [default: 4GiB]'
            cand --max-total-image-bytes 'Bytes of all images of a scene once decoded. [default: 16GiB]'
            cand --max-triangles 'Triangles, each mesh counted once. [default: 500000000]'
            cand --max-vertices 'Vertices, each mesh counted once. [default: 500000000]'
            cand --max-zero-filled 'Elements of a glTF accessor that has no data of its own. [default: 1048576]'
            cand --max-instances 'Meshes that the nodes place in the world. [default: 16777216]'
            cand --max-node-depth 'Nodes beneath one another. [default: 1048576]'
            cand --keep-sums 'The .exr carries the exact sums, so that it can be merged again'
            cand -h 'Print help (see more with ''--help'')'
            cand --help 'Print help (see more with ''--help'')'
        }
        &'lumbre;devices'= {
            cand --json 'Prints one JSON object; memory in bytes'
            cand -h 'Print help'
            cand --help 'Print help'
        }
        &'lumbre;bench'= {
            cand --camera 'Camera of the scenes, by name. May be given several times. [default: each camera; the whole scene in view where there is none]'
            cand --look-from 'Puts the eye here, metres'
            cand --look-at 'Turns the camera to this point, metres'
            cand --fov 'Vertical field of view, degrees'
            cand --sizes 'Sizes of the picture. [default: those of the table, else 1280x720]'
            cand --depths 'Depths, each the most scattering events on a path. [default: those of the table, else --max-depth]'
            cand --samples 'Samples of each pixel in a frame. [default: those of the table, else 1]'
            cand --frames 'Frames that count'
            cand --warm-up 'Frames before them; frames of the first 0.7 s do not count in any case'
            cand --budget 'Most time for the frames of one figure; one frame is always taken'
            cand --spp 'Samples per pixel of `still` and of the noise of `hemisphere`. [default: 1000, 64]'
            cand --triangles 'Triangles of the grids of `build`, at least'
            cand --time 'Time for each device in `equal-time`, and of the edits of `view`'
            cand --max-depth 'Most scattering events on a path. [default: 16]'
            cand --rough-bounces 'How often surfaces that are no mirrors or clear glass may throw light on others: 0 leaves direct light, 1 adds what arrives by one such surface. [default: unlimited]'
            cand --roulette 'First scattering event after which Russian roulette may end a path. [default: 4]'
            cand --sampler 'Random stream. [default: sobol]'
            cand --seed 'Seed of the random stream: another one gives other noise. [default: 0]'
            cand --filter 'Pixel filter. [default: blackman-harris]'
            cand --light-sampling 'Aim rays at the lights (next-event estimation); off: lights are found by chance, and point lights never. [default: on]'
            cand --transmissive-shadows 'What shadow rays do at smooth solid glass and water; thin panes always let light through with their tint. [default: auto]'
            cand --back-faces 'Whether camera rays see the back of single-sided opaque surfaces. [default: cull]'
            cand --clamp 'Most that light which has scattered twice or more may add to a sample at a time, nits (biased: it takes bright dots away, and light with them). [default: no limit]'
            cand --hemisphere 'How diffuse directions are drawn (for comparisons). [default: cosine]'
            cand --sky 'What fills the sky: one radiance (R,G,B linear in nits, or #rrggbb sRGB), a plain `gradient` with a mean near 1, or nothing. [default: what the scene has; the gradient if nothing in it gives light]'
            cand --sun 'A sun: elevation above the horizon and azimuth from -z towards +x, degrees. STRENGTH is the illuminance on a surface that faces it, in lux on the scale of the scene''s lights; 15 by default, which makes a clear day with the gradient sky (a real clear noon is 100000 lux under a sky of some 5000 nits). Its light is slightly warm'
            cand --env 'A latitude-longitude picture of radiance around the scene: .hdr or .exr. Its centre lies at -z'
            cand --env-rotate 'Turns that picture to the right as seen from inside, degrees'
            cand --env-strength 'Factor on its radiance'
            cand --device 'Where to render: `auto`, the best GPU that traces rays, or the CPU where there is none or it fails; `cpu`; `gpu`, the best GPU or an error; `gpu:N`, or the name of a GPU or a part of it. `lumbre devices` lists them'
            cand --threads 'Threads. [default: one for each processor]'
            cand --scene 'Which of the file''s scenes: its name, or its number from 0. [default: the one that the file names, else the first]'
            cand --variant 'Which of the file''s sets of materials, by name. [default: the materials that stand without one]'
            cand --edits 'What was changed of the scene, as `lumbre view` writes it (docs/edits.md says what can stand there): camera, lights, materials, places of things, settings, look. Flags that are given stand above it'
            cand --asset-dir 'Folder from which textures and other files that the scene names may be read too. May be given several times'
            cand --max-file-bytes 'Bytes of one file, such as 4GiB. [default: 8GiB]'
            cand --max-json-bytes 'Bytes of a scene''s JSON. [default: 256MiB]'
            cand --max-json-objects 'Objects in a scene''s JSON, of all kinds together. [default: 4194304]'
            cand --max-json-depth 'Lists and objects of a scene''s JSON inside one another, up to 127. [default: 64]'
            cand --max-buffer-bytes 'Bytes of all buffers of a scene; also of all its encoded images. [default: 16GiB]'
            cand --max-image-side 'Columns or rows of an image. [default: 32768]'
            cand --max-image-bytes 'Bytes of one image once decoded. [default: 4GiB]'
            cand --max-total-image-bytes 'Bytes of all images of a scene once decoded. [default: 16GiB]'
            cand --max-triangles 'Triangles, each mesh counted once. [default: 500000000]'
            cand --max-vertices 'Vertices, each mesh counted once. [default: 500000000]'
            cand --max-zero-filled 'Elements of a glTF accessor that has no data of its own. [default: 1048576]'
            cand --max-instances 'Meshes that the nodes place in the world. [default: 16777216]'
            cand --max-node-depth 'Nodes beneath one another. [default: 1048576]'
            cand --markdown 'Prints the table as Markdown'
            cand --json 'Prints one JSON object; times in seconds or, where the key says so, milliseconds'
            cand --validation 'Lets Vulkan''s validation layer, where it is installed, look over every call of a GPU: slow, for those who change this program'
            cand -h 'Print help (see more with ''--help'')'
            cand --help 'Print help (see more with ''--help'')'
        }
        &'lumbre;completions'= {
            cand -h 'Print help'
            cand --help 'Print help'
        }
        &'lumbre;man'= {
            cand -h 'Print help'
            cand --help 'Print help'
        }
        &'lumbre;help'= {
            cand render 'Render a scene to a picture'
            cand view 'Look at a scene in a window, walk through it and change it'
            cand info 'Say what a scene holds, what it takes, and why its picture might be black'
            cand compare 'Measure how much a picture differs from a reference'
            cand merge 'Add parts of one render, made apart, to the picture of one run'
            cand devices 'List what can render here: the CPU, and every GPU that Vulkan finds, with what it lacks'
            cand bench 'Measure frames per second, rays per second and their like, as tables'
            cand completions 'Print what makes a shell complete the flags of this program'
            cand man 'Print the manual page, or write one for each command'
            cand help 'Print this message or the help of the given subcommand(s)'
        }
        &'lumbre;help;render'= {
        }
        &'lumbre;help;view'= {
        }
        &'lumbre;help;info'= {
        }
        &'lumbre;help;compare'= {
        }
        &'lumbre;help;merge'= {
        }
        &'lumbre;help;devices'= {
        }
        &'lumbre;help;bench'= {
        }
        &'lumbre;help;completions'= {
        }
        &'lumbre;help;man'= {
        }
        &'lumbre;help;help'= {
        }
    ]
    $completions[$command]
}
