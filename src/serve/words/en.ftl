# What the pages of `tailor serve` say. words/de.ftl has the same keys, by test.

skip = Skip to the content
settings = Language and unit
privacy = Everything stays on this machine: nothing is sent to anybody.
to-start = All captures
wrong-title = That did not work

# The first page
home-title = A body measured from photos
home-about = Photos of one full turn of a person become girths, each with an interval, and a report. How to take them: an empty scene first, then a photo every 10° to 20° while the person turns and the camera stands still; tight clothes with a pattern, arms held away from the body.
drop-title = A new capture
drop-hint = Drop the photos of one turn here, or a video, or folders with captures; or choose them.
drop-name = What it is called
drop-files = Photos or a video
drop-folder = Or a folder
drop-folder-hint = Of a folder with several captures, each folder becomes a capture of its own. Photos follow each other by their names; one that is called plate.jpg shows the empty scene.
drop-sending = { $done } of { $of } files are there
drop-looking = All files are there; they are being looked at …
drop-large = { $name } is larger than { $most } MB, the most that is taken
drop-lost = The program does not answer. Is it still running? Start it again, and open the address that it prints.
drop-none = There is no photo and no video among these files.
needs-script = Sending photos needs JavaScript; everything else works without it.
history-title = Captures
history-none = None so far.
column-name = Capture
column-time = When
column-state = State
column-delete = Delete
column-girth = Girth
column-tape = By tape
column-interval = Nine times in ten
delete = Delete
measure-all = Measure all that are not yet
all-csv = All girths as CSV
photos-count = { $count ->
    [one] one file
   *[other] { $count } files
}
unnamed = Without a name
phone-title = From a phone in the same network
phone-about = Open this address on the phone, or point its camera at the code. Whoever has the address may use this page. What is sent can be read by others in this network: use one that you trust.

# A capture
delete-capture = Delete this capture for good
seen-title = The photos
seen-none = The photos are being looked at …
seen-well = Nothing odd was seen.
look = Look at the photos
focal-unknown = focal length unknown
plate-there = with the empty scene
plate-none = without the empty scene
camera-stood = the camera stood still
camera-moved = the camera moved
grade-stop = Stops it:
grade-doubt = Doubt:
grade-hint = Hint:
can-cameras = Cameras
can-lengths = Lengths
can-girths = Girths
photo-place = Photo { $number }: { $name }
photo-odd = look here
photo-sharp = Sharpness
photo-taken = Taken
photo-light = Exposure
photo-burnt = Overexposed
photo-step = Step to the next
photo-tags = Tags
photo-remove = Leave out
photo-remove-this = Leave out { $name }

facts-title = What is known
facts-about = For centimetres one length must be known: the stature, a printed mat of tags, or the disk. All else may be left empty.
facts-keep = Keep
facts-wrong = Something is not right; see the fields that are marked.
fact-stature-cm = Stature
hint-stature-cm = Without shoes. Girths come out in centimetres by it where there is no mat.
fact-mat-tag-mm = Tag of the mat
hint-mat-tag-mm = Edge of a printed tag’s black square, measured on the print.
fact-disk-diameter-cm = Disk
hint-disk-diameter-cm = Diameter of the turning disk.
fact-weight-kg = Weight
hint-weight-kg = For the body mass index.
fact-steps = Steps of a full turn
hint-steps = 18 is a photo every 20°; with a minus if the person turned clockwise seen from above.
fact-focal-mm = Focal length
hint-focal-mm = As on 35 mm film, where the photos do not tell.
fact-plate = Photo of the empty scene
fact-plate-none = None
hint-plate = The same scene without the person: outlines are better with it.
fact-walk = The camera was walked around a person who stood still
fact-quick = A first look: coarser and faster
slip-number = This is not a number.
slip-whole = Only whole steps count.
slip-range = This must lie between { $least } and { $most }.

# Measuring
measuring-title = Measure
measure = Measure
measure-on = Go on
measure-again = Measure again
measure-stopped = Nothing will come of these photos as they are: see what stands below.
stop = Stop
state-none = Not measured yet.
state-waiting = Waits until another capture is measured.
state-running = Being measured
state-done = Measured
state-failed = Nothing came of it
state-stopped = Stopped. What is done is kept; it goes on from there.
state-interrupted = Interrupted: the program was ended while it measured. What is done is kept; it goes on from there.
part-photos = Photos
part-cameras = Cameras
part-masks = Outlines
part-hull = Hull
part-surface = Surface
part-girths = Girths
part-report = Report
step-open = waits
step-begun = begun
step-running = at work
step-done = done
step-failed = came to nothing
step-stopped = stopped
time-left = About { $time } left, by the last time
picture-placed = Where the cameras stood
picture-masks = Outlines of the person
picture-hull = What all outlines leave
picture-body = The surface
warnings = { $count ->
    [one] One thing to know
   *[other] { $count } things to know
}

# Results
result-title = Girths
result-missing = { $count ->
    [one] One girth could not be measured
   *[other] { $count } girths could not be measured
}
result-relative = No length was known, so these are ratios: 1 is the distance of the camera from the disk’s axis. Say the stature or another length, and measure again: it takes seconds.
report = Open the report
downloads = Files to keep
girth-WC = Waist
girth-HC = Hip
girth-CC = Chest
girth-NC = Neck
girth-AC-L = Upper arm, left
girth-AC-R = Upper arm, right
girth-TC-L = Thigh, left
girth-TC-R = Thigh, right
girth-WHR = Waist over hip
girth-WHtR = Waist over stature

# Deleting
delete-title = Delete { $name } for good?
delete-about = This cannot be undone. What goes:
delete-files = { $count ->
    [one] one file that was handed over ({ $size } MB)
   *[other] { $count } files that were handed over ({ $size } MB)
}
delete-results = the girths, the report and the surface
delete-cache = all that was computed from these photos in the cache
delete-yes = Delete for good
delete-no = Keep it
gone-title = { $name } is gone
gone-results = { $count ->
    [one] one result in the cache ({ $size } MB)
   *[other] { $count } results in the cache ({ $size } MB)
}
gone-shared = Another capture had the same photos: what went of its results is made again when it is measured.

# What can be wrong
wrong-missing = This is not here (any more).
wrong-said = { $why }
wrong-broken = The program could not do that: { $why }
wrong-full = The disk is full: make room, then try again. Nothing half-written was kept.
wrong-busy = Something is being measured just now: stop it, or wait until it is done.
wrong-large = This is more than { $most } MB, the most that is taken.
wrong-many = A capture has at most { $most } files.
wrong-heic = This is a HEIC photo, which this program was built without. On the phone choose “Most Compatible” (iPhone: Settings, Camera, Formats) and take or send the photos as JPEG, or convert them: heif-convert IN.heic OUT.jpg
wrong-kind = This is neither a photo (JPEG, PNG, TIFF) nor a video (MP4, MOV, MKV, AVI).
wrong-header = This photo is broken: { $why }
wrong-pixels = This picture says to be { $width } × { $height } pixels; at most { $most } million are read.
wrong-slow = Nothing more came for a minute: send it again.
refused-host = This name leads to tailor, but it is not its own: open the address that the program printed.
refused-origin = Another page asked for this; only tailor’s own pages may.
refused-token = This browser is not known here: open the address that the program printed, with its token.

# The brush
brush-open = Correct outlines
brush-title = Outlines
brush-about = What is dark was taken for room. Paint body where body is lacking, room where too much was taken. With the keyboard: arrows move the brush, space paints, plus and minus change its size.
brush-photo = Photo
brush-paint = Brush
brush-body = Body
brush-room = Room
brush-clear = As it was found
brush-size = Size
brush-undo = Undo
brush-save = Keep this outline
brush-saved = Kept. Paint the next, or measure again: only what comes after the outlines is made anew.
brush-lost = This outline was not kept: { $why }
brush-none = Nothing was painted.
brush-canvas = Photo with its outline; painted with mouse, finger or keys
brush-measured = Outlines were corrected.
brush-forget = Take all corrections back
brush-nothing = There are no outlines yet: measure first. Outlines of a video cannot be corrected here.

# What `doctor` finds (findings.rs)
find-moved = only { $a } % of the picture stand still: the camera, or all behind the person, moved between the photos
find-moved-mend = a turn wants one camera on a tripod and the person on a disk; was the camera walked around a person who stood still? Then say so above
find-shuffled = photos are more like others far away in order than like their neighbours: they are not in turning order
find-shuffled-mend = name the photos in turning order, and hand them over again
find-stranger = far more like one far away in order than like its neighbours
find-stranger-mend = look whether these photos are in their place
find-same = nothing turned between these photos and the next
find-same-mend = leave one of each two out
find-gap = the next photo differs by far more than others do
find-gap-mend = look whether a photo is missing there
find-blurred = blurred beside the others
find-blurred-mend = take them again, or leave them out
find-burnt = overexposed over a tenth of the picture or more
find-black = black over a tenth of the picture or more
find-lost-mend = take them again with the exposure held
find-uneven = exposed from { $a } to { $b } EV against the middle
find-uneven-mend = hold exposure and white balance (on phones: press and hold until AE/AF lock shows)
find-pixels = photos of { $a } × { $b } pixels are small
find-pixels-mend = hand over the camera’s own files
find-head = what moves reaches the upper border: the head may be cut off
find-head-mend = leave room above the head
find-arms = what moves reaches both sides: arms may be cut off, or people walk behind the person
find-arms-mend = step back, and keep the background still
find-mat = a mat is told of, but no tag of it was found
find-mat-mend = is it in view, in good light, and flat?
find-few = { $a } photos are few: without a mat features are followed over steps of 30° at most
find-few-mend = take 18 to 36 photos of a full turn, or lay a mat on the disk
find-focal = nothing tells of the focal length
find-focal-mend = keep EXIF in the photos, or say the focal length above
find-length = no length is known: lengths will be relative
find-length-mend = say the stature or the disk above, or lay a mat on the disk
find-plate = there is no photo of the empty scene
find-plate-mend = take one without the person and call it plate.jpg: outlines become surer
find-can-stopped = no, as it is: see above
find-can-mat = from the mat, photo by photo
find-can-features = from what turns with the person: clothes with a pattern, a patterned cloth on the disk
find-can-walked = not as a turn
find-can-cm = in centimetres, from { $a }
find-can-relative = relative: ratios hold, no centimetres
find-can-no = no
find-can-bmi = yes, with ratios and the body mass index
find-can-ratios = yes, with ratios; the body mass index wants weight and stature
find-from-mat = the marker mat
find-from-reference = the reference length
find-from-disk = the disk’s diameter, if its edge is seen
find-from-stature = the stature

# What stages warn of, and why girths are missing (warnings.rs)
warn-video-steps = frames of a video are not at even steps: `step_deg` was passed over (how many are taken: --set frames.step_deg=)
warn-same-file = { $a } is the same file as { $b } and was left out: if another photo should be in its place, put it there
warn-same-raw = { $a } is the same file as { $b } and was left out
warn-video-plate = { $a } is { $b }×{ $c } pixels, unlike the turn, and was left out: film the empty scene as the turn, and call that plate.mp4
warn-too-many = { $a } photos are more than are of use: the sharpest of each of { $b } even stretches are taken (`most`); steps between them are no longer even
warn-surface-fault = { $a }; sections across it may be missing
warn-video-open = from { $a } to { $b } s something turns, but at its end it does not look as at its beginning: is this a whole turn? All of it was taken; film from before the turn until after it
warn-video-fast = { $a } of { $b } steps of the turn have no frame of their own: turn more slowly
warn-video-blurred = no sharp frame at { $a } s: turn evenly, in more light
warn-video-still = hardly anything moves: is the subject on a disk that turns, and in view?
warn-two-turns = between { $a } and { $b } passed { $c } s, else { $d } s: are these two turns? Put each into a folder of its own, or say which photos are the turn: `images = ["…"]` in capture.toml, or --images
warn-order = { $a } was taken before { $b }: names should be in turning order
warn-other-camera = { $a } was taken with another camera ({ $b }) than most photos ({ $c }): one camera must take all of a turn; take it again, or remove it
warn-zoomed = { $a } was taken at { $b } mm, most photos at { $c } mm: do not zoom during a turn; take it again, or remove it
warn-hull-cut = the hull is cut off where the search for it ended: the photos do not see around the body, or masks and cameras do not belong together
warn-hull-parts = { $a } smaller parts, { $b } % of the volume in all, were left out: if a part of the body is missing, look at the masks
warn-evolve = the evolution made the photos agree less; the mesh is handed on as it came: look at masks and cameras
warn-seen-by-two = only { $a } % of the surface is seen by two photos or more: take more photos of the turn, or look at the masks
warn-agree-less = the photos agree less on the optimized surface than on the one that came in: look at masks and cameras before you trust girths to a millimetre
warn-crossing = { $a } pairs of faces pass through each other: look at the surface there before you take a girth across
warn-open = for a stretch no photo shows the body's outline there, for hands are before it or photos are few, and the surface runs out to a corner: { $a } or so may not be body; take more photos, or hold the hands farther away
warn-split = arm and trunk are one on the surface there and were split: intervals are wider; hold the arms farther away
warn-no-interval = no interval is given, for a part of it that matters is not known (the report says which)
warn-shortened = tapes and their intervals are shortened by { $a } %, as compression_pct declares
warn-nothing = nothing was measured: { $a }
warn-front = no feet tell which way the body faces, so the hip's and the neck's levels may be wrong: do shoes or a long coat hide them?
warn-made-levels = this body is outside of the adults that levels were fitted on (a child, a small figure, an unusual build, or a stature that is wrong): the levels of waist and chest come from made bodies, and their intervals are wider
warn-guessed-levels = this body is unlike all that levels were fitted on: the levels of waist and chest are guesses, with intervals as wide; is the stature right, and is the body whole and upright?
warn-ground-below = the ground that the cameras tell lies { $a } below the soles on the surface: the body does not stand on it; heights and stature are told from the soles
warn-ground-above = the ground that the cameras tell lies { $a } above the soles on the surface: the body does not stand on it; heights and stature are told from the soles
warn-feet-lost = the surface ends { $a } above the ground without feet: they are lost, and heights are told from the ground
warn-density = weight and volume make { $a } kg/l, a living body has 0.93 to 1.1: unless this is none, the scale, the weight or the surface is wrong (is the body cut off?); look at the masks
warn-spline-left = the smooth curve through the surface's points (the spline) is { $a } % off the exact section: the surface is too coarse there; take the tape or the contour
warn-folds = the skin is { $a } % longer than a tape, which points to a hole in the surface or to an arm that touches it: look at the section
warn-mat = a mat is told of, but none was found in the photos: cameras follow from features alone; is it in view, in good light, and flat?
warn-walk-lost = { $a } (photo { $b }) shares too little with the others and has no camera
warn-lost = { $a } (photo { $b }) { $c } and has no camera
warn-few-tags = shows fewer than two tags
warn-shares-little = shares too little with the others
warn-focal = the focal length came out { $a } % from what EXIF or capture.toml says: check `focal_35mm` or `focal_px`
warn-off-circle = its camera stands { $a } % off the circle of the others: did camera or disk move?
warn-degenerate = the photos do not tell all of the cameras, so how sure they are is not to be trusted: lay a mat on the disk, or take more photos
warn-few-features = only { $a } features are seen on other photos, too: lay a mat or a patterned cloth on the disk, or turn by smaller steps
warn-relative = nothing tells of millimetres (no mat, reference, disk or stature that could be seen): lengths are relative to the camera ring's radius, called 1000 mm
warn-no-edge = neither the disk's edge nor soles were seen: the ground lies at the lowest feature, so heights and stature may be off; keep feet and disk in view
warn-two-tags = [mat] says that tags are { $a } mm, [reference] that they are { $b } mm: [mat] was taken; measure a printed tag and correct the other
warn-reference = the reference of kind `{ $a }` is not known here: `subject_height`, `disk_diameter` and `tag_size` are
warn-disagree = { $a } and { $b } disagree by { $c } %: { $d } was taken; check what capture.toml says of both
warn-no-camera = { $a } photos have no camera in the file and are left out
warn-no-circle = the cameras stand on no circle: the file's world was kept; if they are of one turn, check the file
warn-no-unit = the file says nothing of its unit and `unit_mm` is 0: lengths are relative
warn-few-hold = { $a } holds on to only { $b } features: its camera follows from those of the others; is it in its place in the turning order?
warn-few-fit = only { $a } % of the features fit the cameras: look at the camera ring before you trust it
warn-no-focal = the focal length is unknown and the photos hardly tell it: give `focal_35mm` in capture.toml
warn-swayed = the subject moved against the disk (free cameras would follow it): lens and steps were held at what EXIF and capture.toml say, and how sure the cameras are cannot be told
warn-sideways = the photos lie on their side; which end of the subject is up was guessed from where the cameras look down: turn the photos upright to be sure
warn-by-colour = { $a }; so photos are cut by colours alone
warn-no-mask = { $a } has no mask and is left out: put its mask beside the others, under the name of the photo
warn-amid = { $a } % of the features that stand amid the cameras are in no outline: is a part of the subject lacking, or does something stand beside it? look at the masks (`tailor show masks --as sheet`)
warn-border = the subject runs over the border of { $a }: what is cut off is lacking
warn-same-colours = subject and room have nearly the same colours there; look at the masks (`tailor show masks --as sheet`)
warn-unlike = the outline is not what the other photos show; look at the masks (`tailor show masks --as sheet`)
warn-page-weight = the page weighs { $a } MB, more than { $b } MB: lower photo_px, most_faces or atlas_px
warn-no-face = left out, for where its face is cannot be told
warn-mat-about = the mat was recognised: { $a } tags, numbers { $b } to { $c }, on a ring with a radius of { $d } mm, to within { $e } mm ({ $f } % of all lengths): measure it from the middle to a tag's middle and say --mat-ring and --mat-ids { $g }-{ $h }, or hand over the mat's file with --mat
warn-mat-known = the mat was recognised: { $a } tags, numbers { $b } to { $c }, on a ring with a radius of { $d } mm
warn-mat-no-ring = the tags in the photos do not lie on a ring as a mat of `tailor mat` has them: tell of the mat in `[mat]` of capture.toml; the tags are not used
warn-mat-odd = the tags lie on a ring with a radius of { $a } mm if they are { $b } mm wide, and `tailor mat` lays out none like that: measure a printed tag again, or tell of the mat in `[mat]` of capture.toml; the tags are not used
warn-rim-few = capture.toml tells of tags on the disk's rim, but only { $a } observations of them are good for anything: check `[rim]` (ids, count, radius), the light on the rim, and that it is in view
warn-rim-off = the tags on the disk's rim lie { $a } px from where they should be, those on the disk { $b } px: they were left out; measure a printed tag and the disk, and check `tag_size_mm` and `radius_mm` of `[rim]`
warn-tags-unused = marker tags (family 36h11, numbers { $a } to { $b }) are seen on { $c } of { $d } photos that were searched, but nothing is said of them, so they are not used; { $e }
warn-tags-strange = they do not lie as a mat of `tailor mat` does: tell of them in `[mat]` of capture.toml, or cover them
warn-tags-mat = they lie as a mat of `tailor mat` ({ $a } tags on a ring of { $b } times a tag's size): say the edge length of a printed tag's black square as you measure it, such as --mat-tag 60, or hand over the mat's own file with --mat
warn-arm-unlike = an arm is unlike those that its joints' places were fitted on, so its intervals are wider: is it bare, does it hang or reach aside, and is the stature right?
warn-no-plate = there is no plate: the empty scene is guessed from what stands still, and may cost parts of the body; look at the masks, or take one photo without the subject and call it plate.jpg
warn-patch = a patch of a colour that the body has nowhere else counts as body where no photo shows the empty room: is it a bit of wall beside arm or trunk? girths there may be too large; look at these masks
warn-room-moved = between { $a } and { $b } the room moved by { $c } px in the photo: the camera was moved; leave out what was taken before or after, or take the turn again
warn-shows-same = { $a } shows the same as { $b }, nothing turned between them: remove one of them
warn-and-more = and so on, { $a } more photos
warn-no-legs = no two legs were found: is the body cut off, or does a coat or a skirt hide them?
warn-no-neck = no neck was found between head and shoulders: does hair or a collar hide it, or do the photos cut the head off?
warn-neck-groove = the neck is a groove between head and shoulders on the surface, too short for a tape to lie around it: lift the chin
warn-no-head = the top of the surface is flat, not a crown: the head is missing or cut off by the photos' border
warn-not-upright = trunk and legs are not those of an upright body: does it lie, sit, bend over, or stand on its head?
warn-no-ground = no feet end on the ground, so nothing tells heights: is the body cut off, do trousers or a coat hide the feet, or is the ground of the cameras wrong?
warn-no-limb = this limb could not be followed from its end to the trunk: hold it away from the body
warn-fused = limb and trunk are one on the surface there: hold the limb farther away
warn-no-arms = no arm stands clear of the trunk anywhere, so nothing tells whether arms are in this section: hold them away from the body
warn-hand = a hand or forearm is one with the body on the surface there: hold the hands farther away
warn-thighs-one = the thighs are one on the surface well below the crotch, so where they are fullest does not show: stand with the feet farther apart
warn-no-peak = nothing between the joints is fullest there: does a hem, a boot or a bandage hide it?
warn-no-section = the surface has no closed section there
warn-no-extreme = this body is nowhere narrowest or fullest between the marks of this definition: choose another
warn-out-of-range = the body lies outside of what the level model was fitted on, so the level is not known well enough
warn-too-uncertain = the interval would be wider than 25 % to either side, so no number is given
