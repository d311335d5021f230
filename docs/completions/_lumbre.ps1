
using namespace System.Management.Automation
using namespace System.Management.Automation.Language

Register-ArgumentCompleter -Native -CommandName 'lumbre' -ScriptBlock {
    param($wordToComplete, $commandAst, $cursorPosition)

    $commandElements = $commandAst.CommandElements
    $command = @(
        'lumbre'
        for ($i = 1; $i -lt $commandElements.Count; $i++) {
            $element = $commandElements[$i]
            if ($element -isnot [StringConstantExpressionAst] -or
                $element.StringConstantType -ne [StringConstantType]::BareWord -or
                $element.Value.StartsWith('-') -or
                $element.Value -eq $wordToComplete) {
                break
        }
        $element.Value
    }) -join ';'

    $completions = @(switch ($command) {
        'lumbre' {
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help')
            [CompletionResult]::new('-V', '-V ', [CompletionResultType]::ParameterName, 'Print version')
            [CompletionResult]::new('--version', '--version', [CompletionResultType]::ParameterName, 'Print version')
            [CompletionResult]::new('render', 'render', [CompletionResultType]::ParameterValue, 'Render a scene to a picture')
            [CompletionResult]::new('view', 'view', [CompletionResultType]::ParameterValue, 'Look at a scene in a window, walk through it and change it')
            [CompletionResult]::new('info', 'info', [CompletionResultType]::ParameterValue, 'Say what a scene holds, what it takes, and why its picture might be black')
            [CompletionResult]::new('compare', 'compare', [CompletionResultType]::ParameterValue, 'Measure how much a picture differs from a reference')
            [CompletionResult]::new('merge', 'merge', [CompletionResultType]::ParameterValue, 'Add parts of one render, made apart, to the picture of one run')
            [CompletionResult]::new('devices', 'devices', [CompletionResultType]::ParameterValue, 'List what can render here: the CPU, and every GPU that Vulkan finds, with what it lacks')
            [CompletionResult]::new('bench', 'bench', [CompletionResultType]::ParameterValue, 'Measure frames per second, rays per second and their like, as tables')
            [CompletionResult]::new('completions', 'completions', [CompletionResultType]::ParameterValue, 'Print what makes a shell complete the flags of this program')
            [CompletionResult]::new('man', 'man', [CompletionResultType]::ParameterValue, 'Print the manual page, or write one for each command')
            [CompletionResult]::new('help', 'help', [CompletionResultType]::ParameterValue, 'Print this message or the help of the given subcommand(s)')
            break
        }
        'lumbre;render' {
            [CompletionResult]::new('-o', '-o', [CompletionResultType]::ParameterName, 'File to write: .png, .jpg (8 bits a band, for display), .hdr (linear radiance) or .exr (linear, 32-bit floats, with layers); - is standard output, a PNG, or of another format as exr:-. May be given several times. [default: the scene''s name with .png, beside it or in this folder; never a file that is there already]')
            [CompletionResult]::new('--output', '--output', [CompletionResultType]::ParameterName, 'File to write: .png, .jpg (8 bits a band, for display), .hdr (linear radiance) or .exr (linear, 32-bit floats, with layers); - is standard output, a PNG, or of another format as exr:-. May be given several times. [default: the scene''s name with .png, beside it or in this folder; never a file that is there already]')
            [CompletionResult]::new('--size', '--size', [CompletionResultType]::ParameterName, 'Columns and rows of the picture, up to 32768 each. [default: 720 rows in the shape that the camera was framed for, 1280x720 where the scene does not say]')
            [CompletionResult]::new('--background', '--background', [CompletionResultType]::ParameterName, 'What the camera sees behind the scene. What is left out still gives light. [default: scene]')
            [CompletionResult]::new('--first-sample', '--first-sample', [CompletionResultType]::ParameterName, 'Number of the first sample of each pixel. A render can be split: each part takes --spp samples from here, its .exr carries the exact sums, and `lumbre merge` adds them to the bits of one run')
            [CompletionResult]::new('--exposure', '--exposure', [CompletionResultType]::ParameterName, 'Brightness: `auto` makes the log-average luminance middle grey (0.18), `thesis` is 0.5 over the average clamped to 0.1..1, a number is stops: each one more doubles. [default: auto]')
            [CompletionResult]::new('--tone', '--tone', [CompletionResultType]::ParameterName, 'Tone curve: `srgb` and `linear` (gamma 2.2) clip what is brighter than white; `reinhard`, `aces` and `agx` roll it off, and so does `neutral`, which keeps the colours of materials. [default: srgb]')
            [CompletionResult]::new('--vignette', '--vignette', [CompletionResultType]::ParameterName, 'Darkens towards the corners, which keep 1 - X of their light; 0 to 1. [default: 0]')
            [CompletionResult]::new('--aberration', '--aberration', [CompletionResultType]::ParameterName, 'Chromatic aberration: enlarges red about the centre by X per cent and makes blue smaller by as much; -50 to 50. [default: 0]')
            [CompletionResult]::new('--quality', '--quality', [CompletionResultType]::ParameterName, 'Quality of a JPEG')
            [CompletionResult]::new('--mode', '--mode', [CompletionResultType]::ParameterName, 'How the picture is drawn')
            [CompletionResult]::new('--camera-path', '--camera-path', [CompletionResultType]::ParameterName, 'Moves the camera along a way, a line for each place: eye X,Y,Z, what it looks at X,Y,Z, degrees of view if they change. --frames pictures are written, numbered: NAME-0001.png and so on')
            [CompletionResult]::new('--frames', '--frames', [CompletionResultType]::ParameterName, 'With --camera-path: pictures on the way [default: 60]. Else of a hybrid picture: frames before it is written, over which light and edges are gathered [default: 32, or 1 where nothing is]')
            [CompletionResult]::new('--hybrid', '--hybrid', [CompletionResultType]::ParameterName, 'What frames have, where the flags below do not say it')
            [CompletionResult]::new('--soft-shadows', '--soft-shadows', [CompletionResultType]::ParameterName, 'Penumbras of lamps and sun where the camera sees them. [default: that of --hybrid]')
            [CompletionResult]::new('--ambient-occlusion', '--ambient-occlusion', [CompletionResultType]::ParameterName, 'Ambient light stays away from where things meet; without light between surfaces. [default: off]')
            [CompletionResult]::new('--global-illumination', '--global-illumination', [CompletionResultType]::ParameterName, 'Light that sky and surfaces throw on what the camera sees, one ray a pixel. [default: that of --hybrid]')
            [CompletionResult]::new('--light-filter', '--light-filter', [CompletionResultType]::ParameterName, 'Filters the noise of all of these over space and time. [default: that of --hybrid]')
            [CompletionResult]::new('--anti-aliasing', '--anti-aliasing', [CompletionResultType]::ParameterName, 'How edges are made smooth. [default: fxaa for `thesis`, temporal for `all`]')
            [CompletionResult]::new('--render-scale', '--render-scale', [CompletionResultType]::ParameterName, 'Rows and columns that are drawn over those that are shown, 0.5 to 1; with temporal anti-aliasing. [default: 1]')
            [CompletionResult]::new('--planes', '--planes', [CompletionResultType]::ParameterName, 'Writes what the last frame knows of its pixels into this folder, a PNG each: normal, depth, position, albedo, roughness, specularity, mirrored, through, index, emission, object, material, motion, sharp, soft, gathered, filtered')
            [CompletionResult]::new('--ambient', '--ambient', [CompletionResultType]::ParameterName, 'Radiance that stands for light that no ray brings, nits. [default: found from sky and lamps]')
            [CompletionResult]::new('--spp', '--spp', [CompletionResultType]::ParameterName, 'Samples per pixel. [default: 4096 if neither --time nor --target-error is given either]')
            [CompletionResult]::new('--time', '--time', [CompletionResultType]::ParameterName, 'Time for the whole command but the writing of the picture, such as 30s, 1.5min, 1h30min. [default: 10min if neither --spp nor --target-error is given either]')
            [CompletionResult]::new('--target-error', '--target-error', [CompletionResultType]::ParameterName, 'Stop when the picture is this good: the estimated relMSE that `lumbre compare` would find against a perfect one. 0.02 is grainy, 0.005 shows some grain, 0.001 none. 64 samples are taken at least. [default: 0.002 if neither --spp nor --time is given either]')
            [CompletionResult]::new('--save-every', '--save-every', [CompletionResultType]::ParameterName, 'Write the outputs again and again with what there is so far, this far apart')
            [CompletionResult]::new('--max-depth', '--max-depth', [CompletionResultType]::ParameterName, 'Most scattering events on a path. [default: 16]')
            [CompletionResult]::new('--rough-bounces', '--rough-bounces', [CompletionResultType]::ParameterName, 'How often surfaces that are no mirrors or clear glass may throw light on others: 0 leaves direct light, 1 adds what arrives by one such surface. [default: unlimited]')
            [CompletionResult]::new('--roulette', '--roulette', [CompletionResultType]::ParameterName, 'First scattering event after which Russian roulette may end a path. [default: 4]')
            [CompletionResult]::new('--sampler', '--sampler', [CompletionResultType]::ParameterName, 'Random stream. [default: sobol]')
            [CompletionResult]::new('--seed', '--seed', [CompletionResultType]::ParameterName, 'Seed of the random stream: another one gives other noise. [default: 0]')
            [CompletionResult]::new('--filter', '--filter', [CompletionResultType]::ParameterName, 'Pixel filter. [default: blackman-harris]')
            [CompletionResult]::new('--light-sampling', '--light-sampling', [CompletionResultType]::ParameterName, 'Aim rays at the lights (next-event estimation); off: lights are found by chance, and point lights never. [default: on]')
            [CompletionResult]::new('--transmissive-shadows', '--transmissive-shadows', [CompletionResultType]::ParameterName, 'What shadow rays do at smooth solid glass and water; thin panes always let light through with their tint. [default: auto]')
            [CompletionResult]::new('--back-faces', '--back-faces', [CompletionResultType]::ParameterName, 'Whether camera rays see the back of single-sided opaque surfaces. [default: cull]')
            [CompletionResult]::new('--clamp', '--clamp', [CompletionResultType]::ParameterName, 'Most that light which has scattered twice or more may add to a sample at a time, nits (biased: it takes bright dots away, and light with them). [default: no limit]')
            [CompletionResult]::new('--hemisphere', '--hemisphere', [CompletionResultType]::ParameterName, 'How diffuse directions are drawn (for comparisons). [default: cosine]')
            [CompletionResult]::new('--camera', '--camera', [CompletionResultType]::ParameterName, 'Which of the scene''s cameras: its name, that of its node, or its number from 0. [default: the first; the whole scene in view if there is none]')
            [CompletionResult]::new('--look-from', '--look-from', [CompletionResultType]::ParameterName, 'Puts the eye here, metres')
            [CompletionResult]::new('--look-at', '--look-at', [CompletionResultType]::ParameterName, 'Turns the camera to this point, metres')
            [CompletionResult]::new('--fov', '--fov', [CompletionResultType]::ParameterName, 'Vertical field of view, degrees. An orthographic camera becomes a perspective one')
            [CompletionResult]::new('--aperture', '--aperture', [CompletionResultType]::ParameterName, 'Opens the lens, so that only what is in focus is sharp: `f/2.8` as on a camera with a sensor 24 mm high, or the diameter of the lens in metres. [default: everything is sharp]')
            [CompletionResult]::new('--focus', '--focus', [CompletionResultType]::ParameterName, 'What is in focus: a distance in metres along the direction of view, or `auto`, what lies in the centre of the picture. [default: auto]')
            [CompletionResult]::new('--crop', '--crop', [CompletionResultType]::ParameterName, 'Renders only this part of the picture: column and row of its top left pixel, columns and rows. Its pixels are those of the whole picture, to the bit')
            [CompletionResult]::new('--sky', '--sky', [CompletionResultType]::ParameterName, 'What fills the sky: one radiance (R,G,B linear in nits, or #rrggbb sRGB), a plain `gradient` with a mean near 1, or nothing. [default: what the scene has; the gradient if nothing in it gives light]')
            [CompletionResult]::new('--sun', '--sun', [CompletionResultType]::ParameterName, 'A sun: elevation above the horizon and azimuth from -z towards +x, degrees. STRENGTH is the illuminance on a surface that faces it, in lux on the scale of the scene''s lights; 15 by default, which makes a clear day with the gradient sky (a real clear noon is 100000 lux under a sky of some 5000 nits). Its light is slightly warm')
            [CompletionResult]::new('--env', '--env', [CompletionResultType]::ParameterName, 'A latitude-longitude picture of radiance around the scene: .hdr or .exr. Its centre lies at -z')
            [CompletionResult]::new('--env-rotate', '--env-rotate', [CompletionResultType]::ParameterName, 'Turns that picture to the right as seen from inside, degrees')
            [CompletionResult]::new('--env-strength', '--env-strength', [CompletionResultType]::ParameterName, 'Factor on its radiance')
            [CompletionResult]::new('--device', '--device', [CompletionResultType]::ParameterName, 'Where to render: `auto`, the best GPU that traces rays, or the CPU where there is none or it fails; `cpu`; `gpu`, the best GPU or an error; `gpu:N`, or the name of a GPU or a part of it. `lumbre devices` lists them')
            [CompletionResult]::new('--threads', '--threads', [CompletionResultType]::ParameterName, 'Threads. [default: one for each processor]')
            [CompletionResult]::new('--memory-limit', '--memory-limit', [CompletionResultType]::ParameterName, 'Refuse a picture that takes more memory than this: bytes, or with K, M, G or T, powers of 1024. [default: what the system has]')
            [CompletionResult]::new('--progress', '--progress', [CompletionResultType]::ParameterName, 'How to show progress')
            [CompletionResult]::new('--pixel', '--pixel', [CompletionResultType]::ParameterName, 'Instead of a picture, trace one camera sample of this pixel (column, row, from the top left) and print each step on stdout. All other flags must be those of the picture')
            [CompletionResult]::new('--sample', '--sample', [CompletionResultType]::ParameterName, 'Which sample of that pixel, from 0')
            [CompletionResult]::new('--scene', '--scene', [CompletionResultType]::ParameterName, 'Which of the file''s scenes: its name, or its number from 0. [default: the one that the file names, else the first]')
            [CompletionResult]::new('--variant', '--variant', [CompletionResultType]::ParameterName, 'Which of the file''s sets of materials, by name. [default: the materials that stand without one]')
            [CompletionResult]::new('--edits', '--edits', [CompletionResultType]::ParameterName, 'What was changed of the scene, as `lumbre view` writes it (docs/edits.md says what can stand there): camera, lights, materials, places of things, settings, look. Flags that are given stand above it')
            [CompletionResult]::new('--asset-dir', '--asset-dir', [CompletionResultType]::ParameterName, 'Folder from which textures and other files that the scene names may be read too. May be given several times')
            [CompletionResult]::new('--max-file-bytes', '--max-file-bytes', [CompletionResultType]::ParameterName, 'Bytes of one file, such as 4GiB. [default: 8GiB]')
            [CompletionResult]::new('--max-json-bytes', '--max-json-bytes', [CompletionResultType]::ParameterName, 'Bytes of a scene''s JSON. [default: 256MiB]')
            [CompletionResult]::new('--max-json-objects', '--max-json-objects', [CompletionResultType]::ParameterName, 'Objects in a scene''s JSON, of all kinds together. [default: 4194304]')
            [CompletionResult]::new('--max-json-depth', '--max-json-depth', [CompletionResultType]::ParameterName, 'Lists and objects of a scene''s JSON inside one another, up to 127. [default: 64]')
            [CompletionResult]::new('--max-buffer-bytes', '--max-buffer-bytes', [CompletionResultType]::ParameterName, 'Bytes of all buffers of a scene; also of all its encoded images. [default: 16GiB]')
            [CompletionResult]::new('--max-image-side', '--max-image-side', [CompletionResultType]::ParameterName, 'Columns or rows of an image. [default: 32768]')
            [CompletionResult]::new('--max-image-bytes', '--max-image-bytes', [CompletionResultType]::ParameterName, 'Bytes of one image once decoded. [default: 4GiB]')
            [CompletionResult]::new('--max-total-image-bytes', '--max-total-image-bytes', [CompletionResultType]::ParameterName, 'Bytes of all images of a scene once decoded. [default: 16GiB]')
            [CompletionResult]::new('--max-triangles', '--max-triangles', [CompletionResultType]::ParameterName, 'Triangles, each mesh counted once. [default: 500000000]')
            [CompletionResult]::new('--max-vertices', '--max-vertices', [CompletionResultType]::ParameterName, 'Vertices, each mesh counted once. [default: 500000000]')
            [CompletionResult]::new('--max-zero-filled', '--max-zero-filled', [CompletionResultType]::ParameterName, 'Elements of a glTF accessor that has no data of its own. [default: 1048576]')
            [CompletionResult]::new('--max-instances', '--max-instances', [CompletionResultType]::ParameterName, 'Meshes that the nodes place in the world. [default: 16777216]')
            [CompletionResult]::new('--max-node-depth', '--max-node-depth', [CompletionResultType]::ParameterName, 'Nodes beneath one another. [default: 1048576]')
            [CompletionResult]::new('--keep-sums', '--keep-sums', [CompletionResultType]::ParameterName, 'An .exr carries the exact sums of its samples (about 150 bytes a pixel before compression), so that `lumbre merge` can add more; --first-sample implies it')
            [CompletionResult]::new('--validation', '--validation', [CompletionResultType]::ParameterName, 'Lets Vulkan''s validation layer, where it is installed, look over every call of a GPU: slow, for those who change this program')
            [CompletionResult]::new('--stats', '--stats', [CompletionResultType]::ParameterName, 'At the end, say in a table what took how much time and memory; with --progress json as part of the last line')
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            break
        }
        'lumbre;view' {
            [CompletionResult]::new('--size', '--size', [CompletionResultType]::ParameterName, 'Size of the window, in the points of the display. [default: 1280x800]')
            [CompletionResult]::new('--report', '--report', [CompletionResultType]::ParameterName, 'Writes what the window does to a file, a line of JSON for each step: how long it took, what it shows, and where the controls are, for programs that drive it')
            [CompletionResult]::new('--device', '--device', [CompletionResultType]::ParameterName, 'Where to render: `auto`, the best GPU that traces rays, or the CPU where there is none or it fails; `cpu`; `gpu`, the best GPU or an error; `gpu:N`, or the name of a GPU or a part of it. `lumbre devices` lists them')
            [CompletionResult]::new('--threads', '--threads', [CompletionResultType]::ParameterName, 'Threads. [default: one for each processor]')
            [CompletionResult]::new('--scene', '--scene', [CompletionResultType]::ParameterName, 'Which of the file''s scenes: its name, or its number from 0. [default: the one that the file names, else the first]')
            [CompletionResult]::new('--variant', '--variant', [CompletionResultType]::ParameterName, 'Which of the file''s sets of materials, by name. [default: the materials that stand without one]')
            [CompletionResult]::new('--edits', '--edits', [CompletionResultType]::ParameterName, 'What was changed of the scene, as `lumbre view` writes it (docs/edits.md says what can stand there): camera, lights, materials, places of things, settings, look. Flags that are given stand above it')
            [CompletionResult]::new('--asset-dir', '--asset-dir', [CompletionResultType]::ParameterName, 'Folder from which textures and other files that the scene names may be read too. May be given several times')
            [CompletionResult]::new('--max-file-bytes', '--max-file-bytes', [CompletionResultType]::ParameterName, 'Bytes of one file, such as 4GiB. [default: 8GiB]')
            [CompletionResult]::new('--max-json-bytes', '--max-json-bytes', [CompletionResultType]::ParameterName, 'Bytes of a scene''s JSON. [default: 256MiB]')
            [CompletionResult]::new('--max-json-objects', '--max-json-objects', [CompletionResultType]::ParameterName, 'Objects in a scene''s JSON, of all kinds together. [default: 4194304]')
            [CompletionResult]::new('--max-json-depth', '--max-json-depth', [CompletionResultType]::ParameterName, 'Lists and objects of a scene''s JSON inside one another, up to 127. [default: 64]')
            [CompletionResult]::new('--max-buffer-bytes', '--max-buffer-bytes', [CompletionResultType]::ParameterName, 'Bytes of all buffers of a scene; also of all its encoded images. [default: 16GiB]')
            [CompletionResult]::new('--max-image-side', '--max-image-side', [CompletionResultType]::ParameterName, 'Columns or rows of an image. [default: 32768]')
            [CompletionResult]::new('--max-image-bytes', '--max-image-bytes', [CompletionResultType]::ParameterName, 'Bytes of one image once decoded. [default: 4GiB]')
            [CompletionResult]::new('--max-total-image-bytes', '--max-total-image-bytes', [CompletionResultType]::ParameterName, 'Bytes of all images of a scene once decoded. [default: 16GiB]')
            [CompletionResult]::new('--max-triangles', '--max-triangles', [CompletionResultType]::ParameterName, 'Triangles, each mesh counted once. [default: 500000000]')
            [CompletionResult]::new('--max-vertices', '--max-vertices', [CompletionResultType]::ParameterName, 'Vertices, each mesh counted once. [default: 500000000]')
            [CompletionResult]::new('--max-zero-filled', '--max-zero-filled', [CompletionResultType]::ParameterName, 'Elements of a glTF accessor that has no data of its own. [default: 1048576]')
            [CompletionResult]::new('--max-instances', '--max-instances', [CompletionResultType]::ParameterName, 'Meshes that the nodes place in the world. [default: 16777216]')
            [CompletionResult]::new('--max-node-depth', '--max-node-depth', [CompletionResultType]::ParameterName, 'Nodes beneath one another. [default: 1048576]')
            [CompletionResult]::new('--watch', '--watch', [CompletionResultType]::ParameterName, 'Opens the scene again when its file changes')
            [CompletionResult]::new('--validation', '--validation', [CompletionResultType]::ParameterName, 'Lets Vulkan''s validation layer, where it is installed, look over every call of a GPU: slow, for those who change this program')
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            break
        }
        'lumbre;info' {
            [CompletionResult]::new('--size', '--size', [CompletionResultType]::ParameterName, 'Size of the picture whose memory is predicted')
            [CompletionResult]::new('--scene', '--scene', [CompletionResultType]::ParameterName, 'Which of the file''s scenes: its name, or its number from 0. [default: the one that the file names, else the first]')
            [CompletionResult]::new('--variant', '--variant', [CompletionResultType]::ParameterName, 'Which of the file''s sets of materials, by name. [default: the materials that stand without one]')
            [CompletionResult]::new('--edits', '--edits', [CompletionResultType]::ParameterName, 'What was changed of the scene, as `lumbre view` writes it (docs/edits.md says what can stand there): camera, lights, materials, places of things, settings, look. Flags that are given stand above it')
            [CompletionResult]::new('--asset-dir', '--asset-dir', [CompletionResultType]::ParameterName, 'Folder from which textures and other files that the scene names may be read too. May be given several times')
            [CompletionResult]::new('--max-file-bytes', '--max-file-bytes', [CompletionResultType]::ParameterName, 'Bytes of one file, such as 4GiB. [default: 8GiB]')
            [CompletionResult]::new('--max-json-bytes', '--max-json-bytes', [CompletionResultType]::ParameterName, 'Bytes of a scene''s JSON. [default: 256MiB]')
            [CompletionResult]::new('--max-json-objects', '--max-json-objects', [CompletionResultType]::ParameterName, 'Objects in a scene''s JSON, of all kinds together. [default: 4194304]')
            [CompletionResult]::new('--max-json-depth', '--max-json-depth', [CompletionResultType]::ParameterName, 'Lists and objects of a scene''s JSON inside one another, up to 127. [default: 64]')
            [CompletionResult]::new('--max-buffer-bytes', '--max-buffer-bytes', [CompletionResultType]::ParameterName, 'Bytes of all buffers of a scene; also of all its encoded images. [default: 16GiB]')
            [CompletionResult]::new('--max-image-side', '--max-image-side', [CompletionResultType]::ParameterName, 'Columns or rows of an image. [default: 32768]')
            [CompletionResult]::new('--max-image-bytes', '--max-image-bytes', [CompletionResultType]::ParameterName, 'Bytes of one image once decoded. [default: 4GiB]')
            [CompletionResult]::new('--max-total-image-bytes', '--max-total-image-bytes', [CompletionResultType]::ParameterName, 'Bytes of all images of a scene once decoded. [default: 16GiB]')
            [CompletionResult]::new('--max-triangles', '--max-triangles', [CompletionResultType]::ParameterName, 'Triangles, each mesh counted once. [default: 500000000]')
            [CompletionResult]::new('--max-vertices', '--max-vertices', [CompletionResultType]::ParameterName, 'Vertices, each mesh counted once. [default: 500000000]')
            [CompletionResult]::new('--max-zero-filled', '--max-zero-filled', [CompletionResultType]::ParameterName, 'Elements of a glTF accessor that has no data of its own. [default: 1048576]')
            [CompletionResult]::new('--max-instances', '--max-instances', [CompletionResultType]::ParameterName, 'Meshes that the nodes place in the world. [default: 16777216]')
            [CompletionResult]::new('--max-node-depth', '--max-node-depth', [CompletionResultType]::ParameterName, 'Nodes beneath one another. [default: 1048576]')
            [CompletionResult]::new('--json', '--json', [CompletionResultType]::ParameterName, 'Prints one JSON object; lengths in metres, angles in radians, memory in bytes')
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            break
        }
        'lumbre;compare' {
            [CompletionResult]::new('-o', '-o', [CompletionResultType]::ParameterName, 'Writes where they differ (the FLIP map in magma colours; of HDR-FLIP if there is one)')
            [CompletionResult]::new('--output', '--output', [CompletionResultType]::ParameterName, 'Writes where they differ (the FLIP map in magma colours; of HDR-FLIP if there is one)')
            [CompletionResult]::new('--fail-above', '--fail-above', [CompletionResultType]::ParameterName, 'Exits with code 1 if the figure is above this value: rmse, relmse, ldr-flip, hdr-flip, or non-finite (the number of pixels of TEST alone that are no numbers, 0 unless given). May be given several times')
            [CompletionResult]::new('--layer', '--layer', [CompletionResultType]::ParameterName, 'Layer of both EXR files, instead of the picture itself')
            [CompletionResult]::new('--exposure', '--exposure', [CompletionResultType]::ParameterName, 'Brightness at which HDR pictures are shown, as in `lumbre render`')
            [CompletionResult]::new('--json', '--json', [CompletionResultType]::ParameterName, 'Prints one JSON object; an infinite PSNR is null')
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help')
            break
        }
        'lumbre;merge' {
            [CompletionResult]::new('--exposure', '--exposure', [CompletionResultType]::ParameterName, 'Brightness: `auto` makes the log-average luminance middle grey (0.18), `thesis` is 0.5 over the average clamped to 0.1..1, a number is stops: each one more doubles. [default: auto]')
            [CompletionResult]::new('--tone', '--tone', [CompletionResultType]::ParameterName, 'Tone curve: `srgb` and `linear` (gamma 2.2) clip what is brighter than white; `reinhard`, `aces` and `agx` roll it off, and so does `neutral`, which keeps the colours of materials. [default: srgb]')
            [CompletionResult]::new('--vignette', '--vignette', [CompletionResultType]::ParameterName, 'Darkens towards the corners, which keep 1 - X of their light; 0 to 1. [default: 0]')
            [CompletionResult]::new('--aberration', '--aberration', [CompletionResultType]::ParameterName, 'Chromatic aberration: enlarges red about the centre by X per cent and makes blue smaller by as much; -50 to 50. [default: 0]')
            [CompletionResult]::new('--quality', '--quality', [CompletionResultType]::ParameterName, 'Quality of a JPEG')
            [CompletionResult]::new('--max-file-bytes', '--max-file-bytes', [CompletionResultType]::ParameterName, 'Bytes of one file, such as 4GiB. [default: 8GiB]')
            [CompletionResult]::new('--max-json-bytes', '--max-json-bytes', [CompletionResultType]::ParameterName, 'Bytes of a scene''s JSON. [default: 256MiB]')
            [CompletionResult]::new('--max-json-objects', '--max-json-objects', [CompletionResultType]::ParameterName, 'Objects in a scene''s JSON, of all kinds together. [default: 4194304]')
            [CompletionResult]::new('--max-json-depth', '--max-json-depth', [CompletionResultType]::ParameterName, 'Lists and objects of a scene''s JSON inside one another, up to 127. [default: 64]')
            [CompletionResult]::new('--max-buffer-bytes', '--max-buffer-bytes', [CompletionResultType]::ParameterName, 'Bytes of all buffers of a scene; also of all its encoded images. [default: 16GiB]')
            [CompletionResult]::new('--max-image-side', '--max-image-side', [CompletionResultType]::ParameterName, 'Columns or rows of an image. [default: 32768]')
            [CompletionResult]::new('--max-image-bytes', '--max-image-bytes', [CompletionResultType]::ParameterName, 'Bytes of one image once decoded. [default: 4GiB]')
            [CompletionResult]::new('--max-total-image-bytes', '--max-total-image-bytes', [CompletionResultType]::ParameterName, 'Bytes of all images of a scene once decoded. [default: 16GiB]')
            [CompletionResult]::new('--max-triangles', '--max-triangles', [CompletionResultType]::ParameterName, 'Triangles, each mesh counted once. [default: 500000000]')
            [CompletionResult]::new('--max-vertices', '--max-vertices', [CompletionResultType]::ParameterName, 'Vertices, each mesh counted once. [default: 500000000]')
            [CompletionResult]::new('--max-zero-filled', '--max-zero-filled', [CompletionResultType]::ParameterName, 'Elements of a glTF accessor that has no data of its own. [default: 1048576]')
            [CompletionResult]::new('--max-instances', '--max-instances', [CompletionResultType]::ParameterName, 'Meshes that the nodes place in the world. [default: 16777216]')
            [CompletionResult]::new('--max-node-depth', '--max-node-depth', [CompletionResultType]::ParameterName, 'Nodes beneath one another. [default: 1048576]')
            [CompletionResult]::new('--keep-sums', '--keep-sums', [CompletionResultType]::ParameterName, 'The .exr carries the exact sums, so that it can be merged again')
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            break
        }
        'lumbre;devices' {
            [CompletionResult]::new('--json', '--json', [CompletionResultType]::ParameterName, 'Prints one JSON object; memory in bytes')
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help')
            break
        }
        'lumbre;bench' {
            [CompletionResult]::new('--camera', '--camera', [CompletionResultType]::ParameterName, 'Camera of the scenes, by name. May be given several times. [default: each camera; the whole scene in view where there is none]')
            [CompletionResult]::new('--look-from', '--look-from', [CompletionResultType]::ParameterName, 'Puts the eye here, metres')
            [CompletionResult]::new('--look-at', '--look-at', [CompletionResultType]::ParameterName, 'Turns the camera to this point, metres')
            [CompletionResult]::new('--fov', '--fov', [CompletionResultType]::ParameterName, 'Vertical field of view, degrees')
            [CompletionResult]::new('--sizes', '--sizes', [CompletionResultType]::ParameterName, 'Sizes of the picture. [default: those of the table, else 1280x720]')
            [CompletionResult]::new('--depths', '--depths', [CompletionResultType]::ParameterName, 'Depths, each the most scattering events on a path. [default: those of the table, else --max-depth]')
            [CompletionResult]::new('--samples', '--samples', [CompletionResultType]::ParameterName, 'Samples of each pixel in a frame. [default: those of the table, else 1]')
            [CompletionResult]::new('--frames', '--frames', [CompletionResultType]::ParameterName, 'Frames that count')
            [CompletionResult]::new('--warm-up', '--warm-up', [CompletionResultType]::ParameterName, 'Frames before them; frames of the first 0.7 s do not count in any case')
            [CompletionResult]::new('--budget', '--budget', [CompletionResultType]::ParameterName, 'Most time for the frames of one figure; one frame is always taken')
            [CompletionResult]::new('--spp', '--spp', [CompletionResultType]::ParameterName, 'Samples per pixel of `still` and of the noise of `hemisphere`. [default: 1000, 64]')
            [CompletionResult]::new('--triangles', '--triangles', [CompletionResultType]::ParameterName, 'Triangles of the grids of `build`, at least')
            [CompletionResult]::new('--time', '--time', [CompletionResultType]::ParameterName, 'Time for each device in `equal-time`, and of the edits of `view`')
            [CompletionResult]::new('--max-depth', '--max-depth', [CompletionResultType]::ParameterName, 'Most scattering events on a path. [default: 16]')
            [CompletionResult]::new('--rough-bounces', '--rough-bounces', [CompletionResultType]::ParameterName, 'How often surfaces that are no mirrors or clear glass may throw light on others: 0 leaves direct light, 1 adds what arrives by one such surface. [default: unlimited]')
            [CompletionResult]::new('--roulette', '--roulette', [CompletionResultType]::ParameterName, 'First scattering event after which Russian roulette may end a path. [default: 4]')
            [CompletionResult]::new('--sampler', '--sampler', [CompletionResultType]::ParameterName, 'Random stream. [default: sobol]')
            [CompletionResult]::new('--seed', '--seed', [CompletionResultType]::ParameterName, 'Seed of the random stream: another one gives other noise. [default: 0]')
            [CompletionResult]::new('--filter', '--filter', [CompletionResultType]::ParameterName, 'Pixel filter. [default: blackman-harris]')
            [CompletionResult]::new('--light-sampling', '--light-sampling', [CompletionResultType]::ParameterName, 'Aim rays at the lights (next-event estimation); off: lights are found by chance, and point lights never. [default: on]')
            [CompletionResult]::new('--transmissive-shadows', '--transmissive-shadows', [CompletionResultType]::ParameterName, 'What shadow rays do at smooth solid glass and water; thin panes always let light through with their tint. [default: auto]')
            [CompletionResult]::new('--back-faces', '--back-faces', [CompletionResultType]::ParameterName, 'Whether camera rays see the back of single-sided opaque surfaces. [default: cull]')
            [CompletionResult]::new('--clamp', '--clamp', [CompletionResultType]::ParameterName, 'Most that light which has scattered twice or more may add to a sample at a time, nits (biased: it takes bright dots away, and light with them). [default: no limit]')
            [CompletionResult]::new('--hemisphere', '--hemisphere', [CompletionResultType]::ParameterName, 'How diffuse directions are drawn (for comparisons). [default: cosine]')
            [CompletionResult]::new('--sky', '--sky', [CompletionResultType]::ParameterName, 'What fills the sky: one radiance (R,G,B linear in nits, or #rrggbb sRGB), a plain `gradient` with a mean near 1, or nothing. [default: what the scene has; the gradient if nothing in it gives light]')
            [CompletionResult]::new('--sun', '--sun', [CompletionResultType]::ParameterName, 'A sun: elevation above the horizon and azimuth from -z towards +x, degrees. STRENGTH is the illuminance on a surface that faces it, in lux on the scale of the scene''s lights; 15 by default, which makes a clear day with the gradient sky (a real clear noon is 100000 lux under a sky of some 5000 nits). Its light is slightly warm')
            [CompletionResult]::new('--env', '--env', [CompletionResultType]::ParameterName, 'A latitude-longitude picture of radiance around the scene: .hdr or .exr. Its centre lies at -z')
            [CompletionResult]::new('--env-rotate', '--env-rotate', [CompletionResultType]::ParameterName, 'Turns that picture to the right as seen from inside, degrees')
            [CompletionResult]::new('--env-strength', '--env-strength', [CompletionResultType]::ParameterName, 'Factor on its radiance')
            [CompletionResult]::new('--device', '--device', [CompletionResultType]::ParameterName, 'Where to render: `auto`, the best GPU that traces rays, or the CPU where there is none or it fails; `cpu`; `gpu`, the best GPU or an error; `gpu:N`, or the name of a GPU or a part of it. `lumbre devices` lists them')
            [CompletionResult]::new('--threads', '--threads', [CompletionResultType]::ParameterName, 'Threads. [default: one for each processor]')
            [CompletionResult]::new('--scene', '--scene', [CompletionResultType]::ParameterName, 'Which of the file''s scenes: its name, or its number from 0. [default: the one that the file names, else the first]')
            [CompletionResult]::new('--variant', '--variant', [CompletionResultType]::ParameterName, 'Which of the file''s sets of materials, by name. [default: the materials that stand without one]')
            [CompletionResult]::new('--edits', '--edits', [CompletionResultType]::ParameterName, 'What was changed of the scene, as `lumbre view` writes it (docs/edits.md says what can stand there): camera, lights, materials, places of things, settings, look. Flags that are given stand above it')
            [CompletionResult]::new('--asset-dir', '--asset-dir', [CompletionResultType]::ParameterName, 'Folder from which textures and other files that the scene names may be read too. May be given several times')
            [CompletionResult]::new('--max-file-bytes', '--max-file-bytes', [CompletionResultType]::ParameterName, 'Bytes of one file, such as 4GiB. [default: 8GiB]')
            [CompletionResult]::new('--max-json-bytes', '--max-json-bytes', [CompletionResultType]::ParameterName, 'Bytes of a scene''s JSON. [default: 256MiB]')
            [CompletionResult]::new('--max-json-objects', '--max-json-objects', [CompletionResultType]::ParameterName, 'Objects in a scene''s JSON, of all kinds together. [default: 4194304]')
            [CompletionResult]::new('--max-json-depth', '--max-json-depth', [CompletionResultType]::ParameterName, 'Lists and objects of a scene''s JSON inside one another, up to 127. [default: 64]')
            [CompletionResult]::new('--max-buffer-bytes', '--max-buffer-bytes', [CompletionResultType]::ParameterName, 'Bytes of all buffers of a scene; also of all its encoded images. [default: 16GiB]')
            [CompletionResult]::new('--max-image-side', '--max-image-side', [CompletionResultType]::ParameterName, 'Columns or rows of an image. [default: 32768]')
            [CompletionResult]::new('--max-image-bytes', '--max-image-bytes', [CompletionResultType]::ParameterName, 'Bytes of one image once decoded. [default: 4GiB]')
            [CompletionResult]::new('--max-total-image-bytes', '--max-total-image-bytes', [CompletionResultType]::ParameterName, 'Bytes of all images of a scene once decoded. [default: 16GiB]')
            [CompletionResult]::new('--max-triangles', '--max-triangles', [CompletionResultType]::ParameterName, 'Triangles, each mesh counted once. [default: 500000000]')
            [CompletionResult]::new('--max-vertices', '--max-vertices', [CompletionResultType]::ParameterName, 'Vertices, each mesh counted once. [default: 500000000]')
            [CompletionResult]::new('--max-zero-filled', '--max-zero-filled', [CompletionResultType]::ParameterName, 'Elements of a glTF accessor that has no data of its own. [default: 1048576]')
            [CompletionResult]::new('--max-instances', '--max-instances', [CompletionResultType]::ParameterName, 'Meshes that the nodes place in the world. [default: 16777216]')
            [CompletionResult]::new('--max-node-depth', '--max-node-depth', [CompletionResultType]::ParameterName, 'Nodes beneath one another. [default: 1048576]')
            [CompletionResult]::new('--markdown', '--markdown', [CompletionResultType]::ParameterName, 'Prints the table as Markdown')
            [CompletionResult]::new('--json', '--json', [CompletionResultType]::ParameterName, 'Prints one JSON object; times in seconds or, where the key says so, milliseconds')
            [CompletionResult]::new('--validation', '--validation', [CompletionResultType]::ParameterName, 'Lets Vulkan''s validation layer, where it is installed, look over every call of a GPU: slow, for those who change this program')
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help (see more with ''--help'')')
            break
        }
        'lumbre;completions' {
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help')
            break
        }
        'lumbre;man' {
            [CompletionResult]::new('-h', '-h', [CompletionResultType]::ParameterName, 'Print help')
            [CompletionResult]::new('--help', '--help', [CompletionResultType]::ParameterName, 'Print help')
            break
        }
        'lumbre;help' {
            [CompletionResult]::new('render', 'render', [CompletionResultType]::ParameterValue, 'Render a scene to a picture')
            [CompletionResult]::new('view', 'view', [CompletionResultType]::ParameterValue, 'Look at a scene in a window, walk through it and change it')
            [CompletionResult]::new('info', 'info', [CompletionResultType]::ParameterValue, 'Say what a scene holds, what it takes, and why its picture might be black')
            [CompletionResult]::new('compare', 'compare', [CompletionResultType]::ParameterValue, 'Measure how much a picture differs from a reference')
            [CompletionResult]::new('merge', 'merge', [CompletionResultType]::ParameterValue, 'Add parts of one render, made apart, to the picture of one run')
            [CompletionResult]::new('devices', 'devices', [CompletionResultType]::ParameterValue, 'List what can render here: the CPU, and every GPU that Vulkan finds, with what it lacks')
            [CompletionResult]::new('bench', 'bench', [CompletionResultType]::ParameterValue, 'Measure frames per second, rays per second and their like, as tables')
            [CompletionResult]::new('completions', 'completions', [CompletionResultType]::ParameterValue, 'Print what makes a shell complete the flags of this program')
            [CompletionResult]::new('man', 'man', [CompletionResultType]::ParameterValue, 'Print the manual page, or write one for each command')
            [CompletionResult]::new('help', 'help', [CompletionResultType]::ParameterValue, 'Print this message or the help of the given subcommand(s)')
            break
        }
        'lumbre;help;render' {
            break
        }
        'lumbre;help;view' {
            break
        }
        'lumbre;help;info' {
            break
        }
        'lumbre;help;compare' {
            break
        }
        'lumbre;help;merge' {
            break
        }
        'lumbre;help;devices' {
            break
        }
        'lumbre;help;bench' {
            break
        }
        'lumbre;help;completions' {
            break
        }
        'lumbre;help;man' {
            break
        }
        'lumbre;help;help' {
            break
        }
    })

    $completions.Where{ $_.CompletionText -like "$wordToComplete*" } |
        Sort-Object -Property ListItemText
}
