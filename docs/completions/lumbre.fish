# Print an optspec for argparse to handle cmd's options that are independent of any subcommand.
function __fish_lumbre_global_optspecs
    string join \n h/help V/version
end

function __fish_lumbre_needs_command
    # Figure out if the current invocation already has a command.
    set -l cmd (commandline -opc)
    set -e cmd[1]
    argparse -s (__fish_lumbre_global_optspecs) -- $cmd 2>/dev/null
    or return
    if set -q argv[1]
        # Also print the command, so this can be used to figure out what it is.
        echo $argv[1]
        return 1
    end
    return 0
end

function __fish_lumbre_using_subcommand
    set -l cmd (__fish_lumbre_needs_command)
    test -z "$cmd"
    and return 1
    contains -- $cmd[1] $argv
end

complete -c lumbre -n "__fish_lumbre_needs_command" -s h -l help -d 'Print help'
complete -c lumbre -n "__fish_lumbre_needs_command" -s V -l version -d 'Print version'
complete -c lumbre -n "__fish_lumbre_needs_command" -f -a "render" -d 'Render a scene to a picture'
complete -c lumbre -n "__fish_lumbre_needs_command" -f -a "view" -d 'Look at a scene in a window, walk through it and change it'
complete -c lumbre -n "__fish_lumbre_needs_command" -f -a "info" -d 'Say what a scene holds, what it takes, and why its picture might be black'
complete -c lumbre -n "__fish_lumbre_needs_command" -f -a "compare" -d 'Measure how much a picture differs from a reference'
complete -c lumbre -n "__fish_lumbre_needs_command" -f -a "merge" -d 'Add parts of one render, made apart, to the picture of one run'
complete -c lumbre -n "__fish_lumbre_needs_command" -f -a "devices" -d 'List what can render here: the CPU, and every GPU that Vulkan finds, with what it lacks'
complete -c lumbre -n "__fish_lumbre_needs_command" -f -a "bench" -d 'Measure frames per second, rays per second and their like, as tables'
complete -c lumbre -n "__fish_lumbre_needs_command" -f -a "completions" -d 'Print what makes a shell complete the flags of this program'
complete -c lumbre -n "__fish_lumbre_needs_command" -f -a "man" -d 'Print the manual page, or write one for each command'
complete -c lumbre -n "__fish_lumbre_needs_command" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -s o -l output -d 'File to write: .png, .jpg (8 bits a band, for display), .hdr (linear radiance) or .exr (linear, 32-bit floats, with layers); - is standard output, a PNG, or of another format as exr:-. May be given several times. [default: the scene\'s name with .png, beside it or in this folder; never a file that is there already]' -r -F
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l size -d 'Columns and rows of the picture, up to 32768 each. [default: 720 rows in the shape that the camera was framed for, 1280x720 where the scene does not say]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l background -d 'What the camera sees behind the scene. What is left out still gives light. [default: scene]' -r -f -a "scene\t'Its sky or environment'
transparent\t'Nothing: PNG and EXR get alpha, JPEG and HDR black'"
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l first-sample -d 'Number of the first sample of each pixel. A render can be split: each part takes --spp samples from here, its .exr carries the exact sums, and `lumbre merge` adds them to the bits of one run' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l exposure -d 'Brightness: `auto` makes the log-average luminance middle grey (0.18), `thesis` is 0.5 over the average clamped to 0.1..1, a number is stops: each one more doubles. [default: auto]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l tone -d 'Tone curve: `srgb` and `linear` (gamma 2.2) clip what is brighter than white; `reinhard`, `aces` and `agx` roll it off, and so does `neutral`, which keeps the colours of materials. [default: srgb]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l vignette -d 'Darkens towards the corners, which keep 1 - X of their light; 0 to 1. [default: 0]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l aberration -d 'Chromatic aberration: enlarges red about the centre by X per cent and makes blue smaller by as much; -50 to 50. [default: 0]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l quality -d 'Quality of a JPEG' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l mode -d 'How the picture is drawn' -r -f -a "path\t'Unbiased path tracing'
hybrid\t'As in real time: what the camera sees is rasterised, the rest is brought by rays (takes a GPU)'"
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l camera-path -d 'Moves the camera along a way, a line for each place: eye X,Y,Z, what it looks at X,Y,Z, degrees of view if they change. --frames pictures are written, numbered: NAME-0001.png and so on' -r -F
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l frames -d 'With --camera-path: pictures on the way [default: 60]. Else of a hybrid picture: frames before it is written, over which light and edges are gathered [default: 32, or 1 where nothing is]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l hybrid -d 'What frames have, where the flags below do not say it' -r -f -a "thesis\t'Sharp shadows, mirrors, glass, ambient light, FXAA'
all\t'Soft shadows and light between surfaces too, filtered, and temporal anti-aliasing'"
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l soft-shadows -d 'Penumbras of lamps and sun where the camera sees them. [default: that of --hybrid]' -r -f -a "on\t''
off\t''"
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l ambient-occlusion -d 'Ambient light stays away from where things meet; without light between surfaces. [default: off]' -r -f -a "on\t''
off\t''"
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l global-illumination -d 'Light that sky and surfaces throw on what the camera sees, one ray a pixel. [default: that of --hybrid]' -r -f -a "on\t''
off\t''"
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l light-filter -d 'Filters the noise of all of these over space and time. [default: that of --hybrid]' -r -f -a "on\t''
off\t''"
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l anti-aliasing -d 'How edges are made smooth. [default: fxaa for `thesis`, temporal for `all`]' -r -f -a "none\t'None: one sample at the centre of each pixel'
fxaa\t'Each frame by itself'
temporal\t'Over frames'"
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l render-scale -d 'Rows and columns that are drawn over those that are shown, 0.5 to 1; with temporal anti-aliasing. [default: 1]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l planes -d 'Writes what the last frame knows of its pixels into this folder, a PNG each: normal, depth, position, albedo, roughness, specularity, mirrored, through, index, emission, object, material, motion, sharp, soft, gathered, filtered' -r -F
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l ambient -d 'Radiance that stands for light that no ray brings, nits. [default: found from sky and lamps]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l spp -d 'Samples per pixel. [default: 4096 if neither --time nor --target-error is given either]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l time -d 'Time for the whole command but the writing of the picture, such as 30s, 1.5min, 1h30min. [default: 10min if neither --spp nor --target-error is given either]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l target-error -d 'Stop when the picture is this good: the estimated relMSE that `lumbre compare` would find against a perfect one. 0.02 is grainy, 0.005 shows some grain, 0.001 none. 64 samples are taken at least. [default: 0.002 if neither --spp nor --time is given either]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l save-every -d 'Write the outputs again and again with what there is so far, this far apart' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l max-depth -d 'Most scattering events on a path. [default: 16]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l rough-bounces -d 'How often surfaces that are no mirrors or clear glass may throw light on others: 0 leaves direct light, 1 adds what arrives by one such surface. [default: unlimited]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l roulette -d 'First scattering event after which Russian roulette may end a path. [default: 4]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l sampler -d 'Random stream. [default: sobol]' -r -f -a "sobol\t'Owen-scrambled Sobol points: converges faster'
independent\t'Independent random numbers'"
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l seed -d 'Seed of the random stream: another one gives other noise. [default: 0]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l filter -d 'Pixel filter. [default: blackman-harris]' -r -f -a "box\t'Exactly one pixel'
tent\t'Radius of one pixel'
gaussian\t'Standard deviation of half a pixel, radius 1.5'
blackman-harris\t'Radius 1.5 pixels'
point\t'None: all samples at the centre of their pixel'"
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l light-sampling -d 'Aim rays at the lights (next-event estimation); off: lights are found by chance, and point lights never. [default: on]' -r -f -a "on\t''
off\t''"
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l transmissive-shadows -d 'What shadow rays do at smooth solid glass and water; thin panes always let light through with their tint. [default: auto]' -r -f -a "auto\t'Solid glass lets the light of point lights and the sun through straight, with its tint'
physical\t'Solid glass blocks: caustics come from scattered rays alone'
straight\t'Solid glass lets all light through straight'"
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l back-faces -d 'Whether camera rays see the back of single-sided opaque surfaces. [default: cull]' -r -f -a "cull\t'Nothing, as glTF asks'
shade\t'The surface'"
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l clamp -d 'Most that light which has scattered twice or more may add to a sample at a time, nits (biased: it takes bright dots away, and light with them). [default: no limit]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l hemisphere -d 'How diffuse directions are drawn (for comparisons). [default: cosine]' -r -f -a "cosine\t'In proportion to the cosine'
uniform\t'Uniformly: noisier'"
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l camera -d 'Which of the scene\'s cameras: its name, that of its node, or its number from 0. [default: the first; the whole scene in view if there is none]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l look-from -d 'Puts the eye here, metres' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l look-at -d 'Turns the camera to this point, metres' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l fov -d 'Vertical field of view, degrees. An orthographic camera becomes a perspective one' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l aperture -d 'Opens the lens, so that only what is in focus is sharp: `f/2.8` as on a camera with a sensor 24 mm high, or the diameter of the lens in metres. [default: everything is sharp]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l focus -d 'What is in focus: a distance in metres along the direction of view, or `auto`, what lies in the centre of the picture. [default: auto]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l crop -d 'Renders only this part of the picture: column and row of its top left pixel, columns and rows. Its pixels are those of the whole picture, to the bit' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l sky -d 'What fills the sky: one radiance (R,G,B linear in nits, or #rrggbb sRGB), a plain `gradient` with a mean near 1, or nothing. [default: what the scene has; the gradient if nothing in it gives light]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l sun -d 'A sun: elevation above the horizon and azimuth from -z towards +x, degrees. STRENGTH is the illuminance on a surface that faces it, in lux on the scale of the scene\'s lights; 15 by default, which makes a clear day with the gradient sky (a real clear noon is 100000 lux under a sky of some 5000 nits). Its light is slightly warm' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l env -d 'A latitude-longitude picture of radiance around the scene: .hdr or .exr. Its centre lies at -z' -r -F
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l env-rotate -d 'Turns that picture to the right as seen from inside, degrees' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l env-strength -d 'Factor on its radiance' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l device -d 'Where to render: `auto`, the best GPU that traces rays, or the CPU where there is none or it fails; `cpu`; `gpu`, the best GPU or an error; `gpu:N`, or the name of a GPU or a part of it. `lumbre devices` lists them' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l threads -d 'Threads. [default: one for each processor]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l memory-limit -d 'Refuse a picture that takes more memory than this: bytes, or with K, M, G or T, powers of 1024. [default: what the system has]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l progress -d 'How to show progress' -r -f -a "auto\t'A bar on a terminal, plain lines elsewhere'
plain\t'A line on stderr every few seconds'
json\t'One JSON object per line on stdout; the last one has the times'
off\t'No progress (notes and warnings still appear)'"
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l pixel -d 'Instead of a picture, trace one camera sample of this pixel (column, row, from the top left) and print each step on stdout. All other flags must be those of the picture' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l sample -d 'Which sample of that pixel, from 0' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l scene -d 'Which of the file\'s scenes: its name, or its number from 0. [default: the one that the file names, else the first]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l variant -d 'Which of the file\'s sets of materials, by name. [default: the materials that stand without one]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l edits -d 'What was changed of the scene, as `lumbre view` writes it (docs/edits.md says what can stand there): camera, lights, materials, places of things, settings, look. Flags that are given stand above it' -r -F
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l asset-dir -d 'Folder from which textures and other files that the scene names may be read too. May be given several times' -r -F
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l max-file-bytes -d 'Bytes of one file, such as 4GiB. [default: 8GiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l max-json-bytes -d 'Bytes of a scene\'s JSON. [default: 256MiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l max-json-objects -d 'Objects in a scene\'s JSON, of all kinds together. [default: 4194304]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l max-json-depth -d 'Lists and objects of a scene\'s JSON inside one another, up to 127. [default: 64]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l max-buffer-bytes -d 'Bytes of all buffers of a scene; also of all its encoded images. [default: 16GiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l max-image-side -d 'Columns or rows of an image. [default: 32768]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l max-image-bytes -d 'Bytes of one image once decoded. [default: 4GiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l max-total-image-bytes -d 'Bytes of all images of a scene once decoded. [default: 16GiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l max-triangles -d 'Triangles, each mesh counted once. [default: 500000000]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l max-vertices -d 'Vertices, each mesh counted once. [default: 500000000]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l max-zero-filled -d 'Elements of a glTF accessor that has no data of its own. [default: 1048576]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l max-instances -d 'Meshes that the nodes place in the world. [default: 16777216]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l max-node-depth -d 'Nodes beneath one another. [default: 1048576]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l keep-sums -d 'An .exr carries the exact sums of its samples (about 150 bytes a pixel before compression), so that `lumbre merge` can add more; --first-sample implies it'
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l validation -d 'Lets Vulkan\'s validation layer, where it is installed, look over every call of a GPU: slow, for those who change this program'
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -l stats -d 'At the end, say in a table what took how much time and memory; with --progress json as part of the last line'
complete -c lumbre -n "__fish_lumbre_using_subcommand render" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l size -d 'Size of the window, in the points of the display. [default: 1280x800]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l report -d 'Writes what the window does to a file, a line of JSON for each step: how long it took, what it shows, and where the controls are, for programs that drive it' -r -F
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l device -d 'Where to render: `auto`, the best GPU that traces rays, or the CPU where there is none or it fails; `cpu`; `gpu`, the best GPU or an error; `gpu:N`, or the name of a GPU or a part of it. `lumbre devices` lists them' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l threads -d 'Threads. [default: one for each processor]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l scene -d 'Which of the file\'s scenes: its name, or its number from 0. [default: the one that the file names, else the first]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l variant -d 'Which of the file\'s sets of materials, by name. [default: the materials that stand without one]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l edits -d 'What was changed of the scene, as `lumbre view` writes it (docs/edits.md says what can stand there): camera, lights, materials, places of things, settings, look. Flags that are given stand above it' -r -F
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l asset-dir -d 'Folder from which textures and other files that the scene names may be read too. May be given several times' -r -F
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l max-file-bytes -d 'Bytes of one file, such as 4GiB. [default: 8GiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l max-json-bytes -d 'Bytes of a scene\'s JSON. [default: 256MiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l max-json-objects -d 'Objects in a scene\'s JSON, of all kinds together. [default: 4194304]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l max-json-depth -d 'Lists and objects of a scene\'s JSON inside one another, up to 127. [default: 64]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l max-buffer-bytes -d 'Bytes of all buffers of a scene; also of all its encoded images. [default: 16GiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l max-image-side -d 'Columns or rows of an image. [default: 32768]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l max-image-bytes -d 'Bytes of one image once decoded. [default: 4GiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l max-total-image-bytes -d 'Bytes of all images of a scene once decoded. [default: 16GiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l max-triangles -d 'Triangles, each mesh counted once. [default: 500000000]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l max-vertices -d 'Vertices, each mesh counted once. [default: 500000000]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l max-zero-filled -d 'Elements of a glTF accessor that has no data of its own. [default: 1048576]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l max-instances -d 'Meshes that the nodes place in the world. [default: 16777216]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l max-node-depth -d 'Nodes beneath one another. [default: 1048576]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l watch -d 'Opens the scene again when its file changes'
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -l validation -d 'Lets Vulkan\'s validation layer, where it is installed, look over every call of a GPU: slow, for those who change this program'
complete -c lumbre -n "__fish_lumbre_using_subcommand view" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c lumbre -n "__fish_lumbre_using_subcommand info" -l size -d 'Size of the picture whose memory is predicted' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand info" -l scene -d 'Which of the file\'s scenes: its name, or its number from 0. [default: the one that the file names, else the first]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand info" -l variant -d 'Which of the file\'s sets of materials, by name. [default: the materials that stand without one]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand info" -l edits -d 'What was changed of the scene, as `lumbre view` writes it (docs/edits.md says what can stand there): camera, lights, materials, places of things, settings, look. Flags that are given stand above it' -r -F
complete -c lumbre -n "__fish_lumbre_using_subcommand info" -l asset-dir -d 'Folder from which textures and other files that the scene names may be read too. May be given several times' -r -F
complete -c lumbre -n "__fish_lumbre_using_subcommand info" -l max-file-bytes -d 'Bytes of one file, such as 4GiB. [default: 8GiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand info" -l max-json-bytes -d 'Bytes of a scene\'s JSON. [default: 256MiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand info" -l max-json-objects -d 'Objects in a scene\'s JSON, of all kinds together. [default: 4194304]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand info" -l max-json-depth -d 'Lists and objects of a scene\'s JSON inside one another, up to 127. [default: 64]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand info" -l max-buffer-bytes -d 'Bytes of all buffers of a scene; also of all its encoded images. [default: 16GiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand info" -l max-image-side -d 'Columns or rows of an image. [default: 32768]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand info" -l max-image-bytes -d 'Bytes of one image once decoded. [default: 4GiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand info" -l max-total-image-bytes -d 'Bytes of all images of a scene once decoded. [default: 16GiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand info" -l max-triangles -d 'Triangles, each mesh counted once. [default: 500000000]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand info" -l max-vertices -d 'Vertices, each mesh counted once. [default: 500000000]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand info" -l max-zero-filled -d 'Elements of a glTF accessor that has no data of its own. [default: 1048576]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand info" -l max-instances -d 'Meshes that the nodes place in the world. [default: 16777216]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand info" -l max-node-depth -d 'Nodes beneath one another. [default: 1048576]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand info" -l json -d 'Prints one JSON object; lengths in metres, angles in radians, memory in bytes'
complete -c lumbre -n "__fish_lumbre_using_subcommand info" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c lumbre -n "__fish_lumbre_using_subcommand compare" -s o -l output -d 'Writes where they differ (the FLIP map in magma colours; of HDR-FLIP if there is one)' -r -F
complete -c lumbre -n "__fish_lumbre_using_subcommand compare" -l fail-above -d 'Exits with code 1 if the figure is above this value: rmse, relmse, ldr-flip, hdr-flip, or non-finite (the number of pixels of TEST alone that are no numbers, 0 unless given). May be given several times' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand compare" -l layer -d 'Layer of both EXR files, instead of the picture itself' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand compare" -l exposure -d 'Brightness at which HDR pictures are shown, as in `lumbre render`' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand compare" -l json -d 'Prints one JSON object; an infinite PSNR is null'
complete -c lumbre -n "__fish_lumbre_using_subcommand compare" -s h -l help -d 'Print help'
complete -c lumbre -n "__fish_lumbre_using_subcommand merge" -l exposure -d 'Brightness: `auto` makes the log-average luminance middle grey (0.18), `thesis` is 0.5 over the average clamped to 0.1..1, a number is stops: each one more doubles. [default: auto]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand merge" -l tone -d 'Tone curve: `srgb` and `linear` (gamma 2.2) clip what is brighter than white; `reinhard`, `aces` and `agx` roll it off, and so does `neutral`, which keeps the colours of materials. [default: srgb]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand merge" -l vignette -d 'Darkens towards the corners, which keep 1 - X of their light; 0 to 1. [default: 0]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand merge" -l aberration -d 'Chromatic aberration: enlarges red about the centre by X per cent and makes blue smaller by as much; -50 to 50. [default: 0]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand merge" -l quality -d 'Quality of a JPEG' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand merge" -l max-file-bytes -d 'Bytes of one file, such as 4GiB. [default: 8GiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand merge" -l max-json-bytes -d 'Bytes of a scene\'s JSON. [default: 256MiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand merge" -l max-json-objects -d 'Objects in a scene\'s JSON, of all kinds together. [default: 4194304]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand merge" -l max-json-depth -d 'Lists and objects of a scene\'s JSON inside one another, up to 127. [default: 64]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand merge" -l max-buffer-bytes -d 'Bytes of all buffers of a scene; also of all its encoded images. [default: 16GiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand merge" -l max-image-side -d 'Columns or rows of an image. [default: 32768]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand merge" -l max-image-bytes -d 'Bytes of one image once decoded. [default: 4GiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand merge" -l max-total-image-bytes -d 'Bytes of all images of a scene once decoded. [default: 16GiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand merge" -l max-triangles -d 'Triangles, each mesh counted once. [default: 500000000]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand merge" -l max-vertices -d 'Vertices, each mesh counted once. [default: 500000000]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand merge" -l max-zero-filled -d 'Elements of a glTF accessor that has no data of its own. [default: 1048576]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand merge" -l max-instances -d 'Meshes that the nodes place in the world. [default: 16777216]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand merge" -l max-node-depth -d 'Nodes beneath one another. [default: 1048576]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand merge" -l keep-sums -d 'The .exr carries the exact sums, so that it can be merged again'
complete -c lumbre -n "__fish_lumbre_using_subcommand merge" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c lumbre -n "__fish_lumbre_using_subcommand devices" -l json -d 'Prints one JSON object; memory in bytes'
complete -c lumbre -n "__fish_lumbre_using_subcommand devices" -s h -l help -d 'Print help'
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l camera -d 'Camera of the scenes, by name. May be given several times. [default: each camera; the whole scene in view where there is none]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l look-from -d 'Puts the eye here, metres' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l look-at -d 'Turns the camera to this point, metres' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l fov -d 'Vertical field of view, degrees' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l sizes -d 'Sizes of the picture. [default: those of the table, else 1280x720]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l depths -d 'Depths, each the most scattering events on a path. [default: those of the table, else --max-depth]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l samples -d 'Samples of each pixel in a frame. [default: those of the table, else 1]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l frames -d 'Frames that count' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l warm-up -d 'Frames before them; frames of the first 0.7 s do not count in any case' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l budget -d 'Most time for the frames of one figure; one frame is always taken' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l spp -d 'Samples per pixel of `still` and of the noise of `hemisphere`. [default: 1000, 64]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l triangles -d 'Triangles of the grids of `build`, at least' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l time -d 'Time for each device in `equal-time`, and of the edits of `view`' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l max-depth -d 'Most scattering events on a path. [default: 16]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l rough-bounces -d 'How often surfaces that are no mirrors or clear glass may throw light on others: 0 leaves direct light, 1 adds what arrives by one such surface. [default: unlimited]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l roulette -d 'First scattering event after which Russian roulette may end a path. [default: 4]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l sampler -d 'Random stream. [default: sobol]' -r -f -a "sobol\t'Owen-scrambled Sobol points: converges faster'
independent\t'Independent random numbers'"
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l seed -d 'Seed of the random stream: another one gives other noise. [default: 0]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l filter -d 'Pixel filter. [default: blackman-harris]' -r -f -a "box\t'Exactly one pixel'
tent\t'Radius of one pixel'
gaussian\t'Standard deviation of half a pixel, radius 1.5'
blackman-harris\t'Radius 1.5 pixels'
point\t'None: all samples at the centre of their pixel'"
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l light-sampling -d 'Aim rays at the lights (next-event estimation); off: lights are found by chance, and point lights never. [default: on]' -r -f -a "on\t''
off\t''"
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l transmissive-shadows -d 'What shadow rays do at smooth solid glass and water; thin panes always let light through with their tint. [default: auto]' -r -f -a "auto\t'Solid glass lets the light of point lights and the sun through straight, with its tint'
physical\t'Solid glass blocks: caustics come from scattered rays alone'
straight\t'Solid glass lets all light through straight'"
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l back-faces -d 'Whether camera rays see the back of single-sided opaque surfaces. [default: cull]' -r -f -a "cull\t'Nothing, as glTF asks'
shade\t'The surface'"
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l clamp -d 'Most that light which has scattered twice or more may add to a sample at a time, nits (biased: it takes bright dots away, and light with them). [default: no limit]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l hemisphere -d 'How diffuse directions are drawn (for comparisons). [default: cosine]' -r -f -a "cosine\t'In proportion to the cosine'
uniform\t'Uniformly: noisier'"
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l sky -d 'What fills the sky: one radiance (R,G,B linear in nits, or #rrggbb sRGB), a plain `gradient` with a mean near 1, or nothing. [default: what the scene has; the gradient if nothing in it gives light]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l sun -d 'A sun: elevation above the horizon and azimuth from -z towards +x, degrees. STRENGTH is the illuminance on a surface that faces it, in lux on the scale of the scene\'s lights; 15 by default, which makes a clear day with the gradient sky (a real clear noon is 100000 lux under a sky of some 5000 nits). Its light is slightly warm' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l env -d 'A latitude-longitude picture of radiance around the scene: .hdr or .exr. Its centre lies at -z' -r -F
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l env-rotate -d 'Turns that picture to the right as seen from inside, degrees' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l env-strength -d 'Factor on its radiance' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l device -d 'Where to render: `auto`, the best GPU that traces rays, or the CPU where there is none or it fails; `cpu`; `gpu`, the best GPU or an error; `gpu:N`, or the name of a GPU or a part of it. `lumbre devices` lists them' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l threads -d 'Threads. [default: one for each processor]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l scene -d 'Which of the file\'s scenes: its name, or its number from 0. [default: the one that the file names, else the first]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l variant -d 'Which of the file\'s sets of materials, by name. [default: the materials that stand without one]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l edits -d 'What was changed of the scene, as `lumbre view` writes it (docs/edits.md says what can stand there): camera, lights, materials, places of things, settings, look. Flags that are given stand above it' -r -F
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l asset-dir -d 'Folder from which textures and other files that the scene names may be read too. May be given several times' -r -F
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l max-file-bytes -d 'Bytes of one file, such as 4GiB. [default: 8GiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l max-json-bytes -d 'Bytes of a scene\'s JSON. [default: 256MiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l max-json-objects -d 'Objects in a scene\'s JSON, of all kinds together. [default: 4194304]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l max-json-depth -d 'Lists and objects of a scene\'s JSON inside one another, up to 127. [default: 64]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l max-buffer-bytes -d 'Bytes of all buffers of a scene; also of all its encoded images. [default: 16GiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l max-image-side -d 'Columns or rows of an image. [default: 32768]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l max-image-bytes -d 'Bytes of one image once decoded. [default: 4GiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l max-total-image-bytes -d 'Bytes of all images of a scene once decoded. [default: 16GiB]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l max-triangles -d 'Triangles, each mesh counted once. [default: 500000000]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l max-vertices -d 'Vertices, each mesh counted once. [default: 500000000]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l max-zero-filled -d 'Elements of a glTF accessor that has no data of its own. [default: 1048576]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l max-instances -d 'Meshes that the nodes place in the world. [default: 16777216]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l max-node-depth -d 'Nodes beneath one another. [default: 1048576]' -r
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l markdown -d 'Prints the table as Markdown'
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l json -d 'Prints one JSON object; times in seconds or, where the key says so, milliseconds'
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -l validation -d 'Lets Vulkan\'s validation layer, where it is installed, look over every call of a GPU: slow, for those who change this program'
complete -c lumbre -n "__fish_lumbre_using_subcommand bench" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c lumbre -n "__fish_lumbre_using_subcommand completions" -s h -l help -d 'Print help'
complete -c lumbre -n "__fish_lumbre_using_subcommand man" -s h -l help -d 'Print help'
complete -c lumbre -n "__fish_lumbre_using_subcommand help; and not __fish_seen_subcommand_from render view info compare merge devices bench completions man help" -f -a "render" -d 'Render a scene to a picture'
complete -c lumbre -n "__fish_lumbre_using_subcommand help; and not __fish_seen_subcommand_from render view info compare merge devices bench completions man help" -f -a "view" -d 'Look at a scene in a window, walk through it and change it'
complete -c lumbre -n "__fish_lumbre_using_subcommand help; and not __fish_seen_subcommand_from render view info compare merge devices bench completions man help" -f -a "info" -d 'Say what a scene holds, what it takes, and why its picture might be black'
complete -c lumbre -n "__fish_lumbre_using_subcommand help; and not __fish_seen_subcommand_from render view info compare merge devices bench completions man help" -f -a "compare" -d 'Measure how much a picture differs from a reference'
complete -c lumbre -n "__fish_lumbre_using_subcommand help; and not __fish_seen_subcommand_from render view info compare merge devices bench completions man help" -f -a "merge" -d 'Add parts of one render, made apart, to the picture of one run'
complete -c lumbre -n "__fish_lumbre_using_subcommand help; and not __fish_seen_subcommand_from render view info compare merge devices bench completions man help" -f -a "devices" -d 'List what can render here: the CPU, and every GPU that Vulkan finds, with what it lacks'
complete -c lumbre -n "__fish_lumbre_using_subcommand help; and not __fish_seen_subcommand_from render view info compare merge devices bench completions man help" -f -a "bench" -d 'Measure frames per second, rays per second and their like, as tables'
complete -c lumbre -n "__fish_lumbre_using_subcommand help; and not __fish_seen_subcommand_from render view info compare merge devices bench completions man help" -f -a "completions" -d 'Print what makes a shell complete the flags of this program'
complete -c lumbre -n "__fish_lumbre_using_subcommand help; and not __fish_seen_subcommand_from render view info compare merge devices bench completions man help" -f -a "man" -d 'Print the manual page, or write one for each command'
complete -c lumbre -n "__fish_lumbre_using_subcommand help; and not __fish_seen_subcommand_from render view info compare merge devices bench completions man help" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
