# The program's texts: the pages of `tailor serve`, the first screen of `tailor measure`. de.ftl has the same keys, by test.

skip = Skip to the content
settings = Language and unit
privacy = Everything stays on this machine: nothing is sent to anybody.
to-start = All captures
wrong-title = That did not work

# The first page
home-title = A body measured from photos
home-about = Photos of one full turn of a person become girths, each with an interval, and a report. How to take them: an empty scene first, then a photo every 10° to 20° while the person turns and the camera stays in place; close-fitting clothes, best with a pattern, or underwear; hair up, arms away from the body.
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
column-tape = Tape
column-interval = 90 % interval
delete = Delete
measure-all = Measure all that are not yet
all-csv = All girths as CSV
photos-count = { $count ->
    [one] one file
   *[other] { $count } files
}
unnamed = Without a name
phone-title = From a phone in the same network
phone-about = Open this address on the phone, or point its camera at the code. Whoever has the address may use this page. What is sent can be read by other people in this network: use one that you trust.

# A capture
delete-capture = Delete this capture for good
seen-title = The photos
seen-none = The photos are being looked at …
seen-well = Nothing odd was seen.
look = Look at the photos
focal-unknown = focal length unknown
plate-there = with the empty scene
plate-none = without the empty scene
camera-stood = the camera did not move
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
facts-stale = Not kept: another window changed { $fields } meanwhile. Look at the marked fields; “Keep” once more replaces what the other window kept.
fact-stature-cm = Stature
hint-stature-cm = Without shoes. Girths come out in centimetres by it where there is no mat.
fact-mat-tag-mm = Tag of the mat
hint-mat-tag-mm = Edge of a printed tag’s black square, measured on the print.
fact-disk-diameter-cm = Disk
hint-disk-diameter-cm = Diameter of the turning disk.
fact-weight-kg = Weight
hint-weight-kg = For the body mass index.
fact-sex = Sex
fact-sex-none = Not given
fact-sex-female = Female
fact-sex-male = Male
hint-sex = For reference values: thresholds of adults, growth of children.
fact-age-years = Age in years
hint-age-years = On the day of the photos; 9.5 is nine and a half. For children from 5 to 19: how they compare with the WHO’s growth reference.
fact-steps = Steps of a full turn
hint-steps = 18 is a photo every 20°; with a minus if the person turned clockwise seen from above.
fact-focal-mm = Focal length
hint-focal-mm = As on 35 mm film, where the photos do not record it.
fact-plate = Photo of the empty scene
fact-plate-none = None
hint-plate = The same scene without the person: outlines are better with it.
fact-walk = The camera was walked around a person who did not move
fact-quick = A first look: coarser and faster
fact-empty = empty
fact-on = ticked
fact-off = not ticked
slip-number = This is not a number.
slip-whole = Only whole steps count.
slip-range = This must be between { $least } and { $most }.
slip-stale = Meanwhile: { $now }. Keep again to use what you entered.

# Measuring
measuring-title = Measure
measure = Measure
measure-on = Go on
measure-again = Measure again
measure-stopped = Nothing will come of these photos as they are: see below.
stop = Stop
state-none = Not measured yet.
state-waiting = Waits until another capture is measured.
state-running = Being measured
state-done = Measured
state-nothing = No girth could be measured
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
picture-placed = Where the cameras were
picture-masks = Outlines of the person
picture-hull = What all outlines leave
picture-body = The surface
warnings = { $count ->
    [one] One thing to know
   *[other] { $count } things to know
}

# Results
result-title = Girths
result-none = No girth could be measured, for the reasons below.
result-missing = { $count ->
    [one] One girth could not be measured
   *[other] { $count } girths could not be measured
}
result-relative = No length was known, so these are ratios: 1 is the distance of the camera from the disk’s axis. Give the stature or another length, and measure again: it takes seconds.
result-disputed = Known lengths contradict each other, so these are ratios: 1 is the distance of the camera from the disk’s axis. Correct one of them, or leave one out, and measure again: it takes seconds.
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
girth-WC-natural = Waist, natural
girth-WC-narrowest = Waist, narrowest
girth-WC-navel = Waist at the navel
girth-WC-hip-bone = Waist at the hip bone
girth-HC-max = Hip, greatest
girth-AC = Upper arm, mean
girth-CFC-L = Calf, left
girth-CFC-R = Calf, right
girth-arms = Upper arms
girth-thighs = Thighs
girth-calves = Calves
girth-stature = Stature
girth-WHR = Waist over hip
girth-WHtR = Waist over stature
girth-WHR-tape = Waist over hip, tapes
girth-density-kg-l = Density, kg/l
result-bmi = Body mass index
result-bmi-for-age = Body mass index for age, WHO 2007
result-height-for-age = Height for age, WHO 2007
result-centile = centile { $centile }
result-growth = z is the number of standard deviations between this child and the median of the same sex and age. A reference, no diagnosis.

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
gone-unread = Not all of it may be gone: a newer version of the program wrote these files in the cache, or they cannot be read. Remove them, or let the program that wrote them forget the capture.
gone-shared = Another capture had the same photos: what went of its results is made again when it is measured.

# What can be wrong
wrong-missing = This is not here (any more).
wrong-json = This is not valid JSON: { $why }
wrong-object = A JSON object is expected, not a list or a single value.
wrong-media = Send JSON, with the header Content-Type: application/json.
wrong-request = This request cannot be read: { $why }
wrong-method = This address does not take this kind of call.
wrong-said = { $why }
wrong-plate = There is no photo { $number } in this capture (files: { $files }): give the number of one of its photos.
wrong-broken = The program could not do that: { $why }
wrong-full = The disk is full: free some space, then try again. Nothing half-written was kept.
wrong-busy = Something is being measured just now: stop it, or wait until it is done.
wrong-stale = What is known was changed meanwhile: read it again before you change it.
wrong-large = This is more than { $most } MB, the most that is taken.
wrong-many = A capture has at most { $most } files.
wrong-heic = This is a HEIC photo, which this program was built without. On the phone choose “Most Compatible” (iPhone: Settings, Camera, Formats) and take or send the photos as JPEG, or convert them: heif-convert IN.heic OUT.jpg
wrong-kind = This is neither a photo (JPEG, PNG, TIFF) nor a video (MP4, MOV, MKV, AVI).
wrong-header = This photo is broken: { $why }
wrong-pixels = This picture claims to be { $width } × { $height } pixels; at most { $most } million are read.
wrong-slow = Nothing more came for a minute: send it again.
refused-host = This name leads to tailor, but it is not its own: open the address that the program printed.
refused-origin = Another page asked for this; only tailor’s own pages may.
refused-address = Another page opened this address, and tailor refuses that for safety. Open a new tab and copy the address that the program printed into its address bar.
refused-token = This browser is not known here: open the address that the program printed, with its token.

# The brush
brush-open = Correct outlines
brush-title = Outlines
brush-about = Dark areas count as background. Paint “Body” where part of the body is missing, “Background” where too much is included. With the keyboard: arrows move the brush, space paints, plus and minus change its size.
brush-photo = Photo
brush-paint = Brush
brush-body = Body
brush-room = Background
brush-clear = As it was found
brush-size = Size
brush-undo = Undo
brush-save = Keep this outline
brush-saved = Kept. Paint the next, or measure again: only what comes after the outlines is made anew.
brush-lost = This outline was not kept: { $why }
brush-none = Nothing was painted.
brush-unkept = Not kept yet: { $photos }
brush-canvas = Photo with its outline; painted with mouse, finger or keys
brush-measured = Outlines were corrected.
brush-forget = Take all corrections back
brush-nothing = There are no outlines yet: measure first. Outlines of a video cannot be corrected here.

# The first screen of `tailor measure`
screen-found = { $count ->
    [one] one photo of { $size } megapixels
   *[other] { $count } photos of { $size } megapixels
}
screen-own-masks = masks of its folder
screen-video = from a video
screen-scan = a surface from a file
screen-mat = a mat of { $count } tags
screen-mat-some = a mat of tags
screen-over = { $step }: done
screen-cached = { $step }: in the cache
screen-left = about { $time } left
screen-first = first answer, refined below: { $girths }
screen-none = neither waist nor hip
screen-first-report = first report: { $path }
screen-cameras = { $name }: { $with } of { $of } photos have a camera
screen-lengths = lengths come from { $from } (± { $percent } %)
screen-lengths-unsure = lengths come from { $from } (how sure: unknown)
screen-from-mat = the marker mat
screen-from-tags = the marker tags
screen-from-reference = the reference length
screen-from-disk = the disk’s diameter
screen-from-stature = the stature
screen-given = the cameras that were given
screen-relative = LENGTHS ARE RELATIVE, for nothing of known length was given: ratios hold, and 1 is the camera ring’s radius
screen-disputed = LENGTHS ARE RELATIVE, for known lengths contradict each other (see below): ratios hold, and 1 is the camera ring’s radius
screen-girth = girth
screen-tape = tape { $unit }
screen-tape-relative = relative
screen-interval = interval (90 %)
screen-contour = contour
screen-range = { $low } to { $high }
screen-unknown = unknown: { $parts }
screen-shortened = tapes are shortened by { $percent } %, as compression_pct declares
screen-child = z, WHO 2007; centile { $centile }; no diagnosis
screen-missing = not measured
screen-warnings = { $count ->
    [one] 1 warning
   *[other] { $count } warnings
}
screen-again = to repeat it
screen-files = all files: { $path }
screen-report = report:    { $path }

# `tailor doctor`
mat-next = print at 100 % and check that the ruler is 100 mm long
    the lines for capture.toml are at each page's foot and in { $facts }; or: tailor measure DIR --mat { $print }
mat-tags = tags
mat-tag-size = tag size
mat-tags-on-the-rim = tags on the rim
mat-their-size = their size
mat-ring-radius = ring radius
doctor-photos = { $count ->
    [one] 1 photo of { $size } pixels
   *[other] { $count } photos of { $size } pixels
}
doctor-plate = with the empty scene ({ $name })
doctor-no-plate = no photo of the empty scene
doctor-stood = the camera stood still ({ $still } % of the picture does)
doctor-moved = the camera moved ({ $still } % of the picture do not move)
doctor-noise-plate = noise: { $levels } grey levels (photos against the plate)
doctor-noise-neighbours = noise: { $levels } grey levels (photos against their neighbours, where nothing moved)
doctor-noise-none = noise: not measured (no two pictures show the same)
doctor-odd = what is odd
doctor-stop = stop
doctor-doubt = doubt
doctor-hint = hint
doctor-can = what can be measured
doctor-cameras = cameras
doctor-lengths = lengths
doctor-girths = girths
doctor-turning = turning

# Messages by their codes, where a page needs other words than a terminal: it has fields and outlines, no flags, files or masks. The
# other messages are as the stages have them (`messages!` and `failures!`).
fail-adrift = { $few } of { $of } photos hold on to fewer than { $least } features ({ $names }), so the cameras' places are not known: are they in turning order, at steps below 30°? Was the camera walked around somebody who did not move (then mark it above)? A patterned cloth or a printed mat of tags on the disk helps
fail-all-differs = { $name }: nearly all of it differs from the empty scene: was the camera moved, or the light changed, while the photos were taken?
fail-apart = the photos share too few features that turn with the disk ({ $pairs } of { $of } neighbouring photos do): put a patterned cloth or a printed mat of tags on the disk, or photograph at smaller steps
fail-contradict = two lengths that were given ({ $first }; { $other }) contradict each other by { $off }, so the body's size is not known: one of them is wrong (correct it, or leave out the one you are less sure of), or the outlines lack legs or head, or the cameras are wrong (take more photos, or put a mat on the disk)
fail-copies = only { $found } of { $files } photos differ, but a turn needs at least { $least }; copies of another photo: { $copies }; hand over each photo once
fail-count = { $promised } photos were given, but { $found } are there{ $copies }: add what is missing, or correct the number
fail-few-no-mat = there are { $count } photos: without a mat of tags features are followed from photo to photo, which needs a full turn at steps of 30° or less; take 18 to 36 photos, or lay a printed mat on the disk and give the size of its tags, or give the steps of the full turn
fail-few-photos = photos in turning order: { $found }, but a turn needs at least { $least }: add the other photos of the turn
fail-misplaced = { $count ->
    [one] One photo is
   *[other] { $count } photos are
} out of turning order ({ $names }): { $photo } shows what is between { $before } and { $after }; rename the photos into their order, or leave out those that are not
fail-folded = { $pairs } of { $of } pairs of photos that came out within { $apart } of each other have fewer than { $least } features in common, so different sides of the body were laid on each other: put the photos into turning order, or a printed mat of tags on the disk; did the person turn on the spot, without a disk (then mark it above)?
fail-hopeless = { $why }
fail-hull-contradicted = no point of space is body on all photos: the outline on { $names } cuts away up to { $percent } of what nearly all other photos show; look at this outline, correct it, or leave the photo out
fail-hull-few = only { $count } photos have both an outline and a camera, but a hull needs at least 3
fail-hull-memory = cells of { $voxel_mm } mm would need about { $need } of memory, but { $most } may be taken: is the scale right (stature, mat, disk)? A first look takes coarser cells
fail-hull-nothing = no point of space is body on { $share } of the photos: do outlines and cameras belong together? Look at the outlines
fail-loose = features are { $rms } from where they should (at most { $most } is to be trusted), so the cameras are not: too little texture, a person who moved, photos out of order or cropped, or a camera that was walked around (then mark it above); put a patterned cloth or a printed mat of tags on the disk
fail-mask-empty = the outline of { $name } is { $what }: correct or remove it
fail-mat-misfit = the mat does not fit what is given of it: its tags are seen { $rms } from where they should be; measure a printed tag again
fail-mat-unseen = only { $seen } of { $of } photos show two tags of the mat: check the light on the disk, that it is in view, and the size of a tag
fail-mixed-sizes = photos are of several sizes, but one camera must take all of a turn, uncropped: { $most } are { $size }, { $odd }; leave out what does not belong to the turn
fail-no-beginning = no two photos have enough in common to begin with: photograph at smaller steps, with more texture, or with a printed mat of tags on the disk
fail-no-body = the surface is empty or below the ground, so there is no body to measure: look at the outlines
fail-no-images = the photos were given as { $pattern }, but { $found }: correct it, or leave it out{ $below }
fail-no-photos = there are no photos in { $folder } (JPEG, PNG or TIFF): copy those of the turn there
fail-no-plate = there is no photo of the empty scene, and without cameras the body cannot be separated from the background: take one photo of the same scene without the person
fail-no-ring = the cameras came out { $off } off a ring, so they are not to be trusted: was the camera walked around somebody who did not move (then mark it above)? Are the photos in turning order and the steps below 25°? The focal length, the steps of the turn, or a printed mat of tags on the disk help
fail-no-subject = { $name }: nothing in it differs from the empty scene: is the person in it, or was the camera moved after the photo of the empty scene?
fail-no-such-plate = the empty scene was given as { $name }, but there is no such file{ $near }: correct it, or leave it out (a photo called plate.jpg is found without it)
fail-no-texture = no tags of the given mat were found, and no features that turn with the disk, so the camera's place is not known: are the photos in turning order, at steps below 30°? A patterned cloth or a printed mat of tags on the disk helps
fail-no-video = there is no video here (mp4, mov, mkv, …)
fail-not-installed = { $name } is not installed on this machine, and { $what } cannot be read without it: apt install { $package }
fail-on-side = the photos are on their side: up from the disk runs to their left or right edge. Turn them by 90° in a viewer that saves them
fail-in-view = { $why }
fail-mat-file = { $file } describes no mat: give the file of the printed mat (.pdf, .svg or .toml), or the edge length of a printed tag’s black square
fail-mat-unreadable = { $file }: { $why }
fail-number-beyond = { $flag }: { $text } is not from { $least } to { $most }{ $unit }{ $hint }
fail-out-of-another = { $out } holds something else than the results of { $capture }: nothing was written; give another folder
fail-out-of-somebody = { $file } was not written by tailor: nothing was written; give an empty folder
fail-photos-one-by-one = these are photos of one folder, each of which would be a capture: hand over { $folder }
fail-plate-moves = there is no photo of the empty scene, and only { $still } of the photos’ pixels do not move over the turn: did the camera move? Take a photo of the empty scene, with a fixed camera
fail-several-videos = there are { $count } videos ({ $names }), and one turn is one of them: hand over one, such as { $first }
fail-surface-empty = the surface is empty: look at the outlines
fail-surface-fault = the surface cannot be refined ({ $fault }): look at the outlines
fail-surface-unseen = no part of the surface is seen by two photos: look at cameras and outlines
fail-unexplained = no turn about one axis explains the features: only { $share } of them fit; did the camera move (was it walked around the person? mark it above), are the photos out of order, or does the background fill them? A printed mat of tags on the disk helps
fail-upside-down = the photos are upside down: up from the mat runs to their bottom edge. Turn them by 180° in a viewer that saves them
fail-video-long = { $name } is { $minutes } long, and more than { $most } min are not looked through: cut it to the turn
fail-walk-border = the person runs over the border of { $count } of { $of } photos ({ $names }): take photos that show the whole person
fail-walk-colours = person and background have nearly the same colours: beside the outline only { $share } of the pixels are on the side of their colour ({ $least } are asked for), so the outlines would be guesses: take the photos before another background
fail-walk-contradict = the outlines contradict each other: each shares only { $share } with what all together show ({ $least } are asked for): did the person move, or was the person aside?
fail-walk-depth = no two photos show the same things from places well apart, so depth is not known: walk around the person, a step of 10° to 20° from photo to photo (turning the camera on the spot does not help)
fail-walk-lacking = { $share } of the features amid the cameras are in no outline (at most { $most } may be): a part of the person has the background’s colours, or more than the person is there: take the photos before another background
fail-walk-loose = features are { $rms } from where they should (at most { $most } is to be trusted), so the cameras are not: did the person move while the camera walked, or is most of what is seen water, glass or people?
fail-walk-nothing = nothing amid the cameras differs from the background by its colours: is the person in the middle of the photos? Take the photos before another background
fail-walk-nowhere = there is no place that nearly all cameras look at: keep the person amid the photos
fail-walk-open = the cameras leave { $gap } around the person open: walk all the way round
fail-walk-still = the camera did not walk: of what the photos have in common, { $still } features do not move in the picture and only { $moved } move; if the person turned before a camera on a tripod, take away the mark at “the camera was walked around” above
fail-walk-unsettled = the outlines do not settle: those of the last two passes share only { $share } ({ $least } are asked for): take the photos before another background
fail-walk-views = only { $found } photos have a camera, but to separate a person from the background by a walk around takes at least { $least }: take more photos, all the way round
find-can-features = from what turns with the person: clothes with a pattern, a patterned cloth on the disk
find-can-ratios = yes, with ratios; the body mass index wants weight and stature
find-can-turning = a person turns before a fixed camera: without a disk, measure so, with the stature
find-empty = the person, seen in all other photos, is not seen here
find-empty-plate = if this is the empty scene, choose it above as its photo; else leave it out, or take it again
find-focal-mend = keep EXIF in the photos, or give the focal length above
find-length-mend = give the stature or the disk above, or lay a mat on the disk
find-mat-other-mend = hand over the file of the mat on the disk, or correct what is given of it
find-moved = only { $still } of the picture do not move: the camera, or all behind the person, moved between the photos
find-moved-mend = a turn wants one camera on a tripod and the person on a disk; was the camera walked around a person who did not move? Then mark it above
find-noise-mend = outlines may lose parts where clothes have the background's colour: take the photos in more light, at a lower ISO, or in clothes that differ more from the background
find-pixels-mend = hand over the camera’s own files
find-plate-mend = take one without the person and call it plate.jpg: outlines become surer
find-shuffled-mend = name the photos in turning order, and hand them over again
photos-below = ; folders in folders are read on the command line alone
warn-amid = { $share } of the features amid the cameras are in no outline: is a part of the subject missing, or is something beside it? look at the outlines
warn-born-later = the capture is before the day of birth
warn-born-no-day = the day of birth is given, but not that of the capture, so the age is not known: give the age
warn-bottom = what is under the person is taken for part of it, down to { $height }, where photos begin to cut it off
warn-capture-toml = in the facts of the capture: { $what }
warn-contradicted = its outline leaves out body that all other photos show ({ $share } of it): look at this outline and correct it
warn-density = weight / volume = { $density }, but bodies have 0.93 to 1.1: unless this is a dummy, scale, weight or surface is wrong (is the body cut off?); look at the outlines
warn-disagree = { $other } and { $first } differ by { $off }: { $first } was taken; check what was given of both
warn-disputed = { $other } was given as { $given }, but by { $first } it is { $seen }, and neither can err by so much: lengths are relative, without centimetres; correct one of the two, leave out the one that you are less sure of, or look whether the outlines lack legs or head
warn-empty-photo = a photo shows no subject: leave it out, or correct its outline
warn-empty-photos = next to no subject is seen on { $names }: leave such photos out, or correct their outlines
warn-focal = the focal length came out { $off } from the one that was given or that the photos have: check it
warn-hangs-apart = the surface holds { $share } of what all outlines show as body, the rest hangs apart from it and was left out: look where the outlines cut the body through
warn-hull-parts = smaller parts left out: { $count }, { $left_out } of the volume in all; if a part of the body is missing, look at the outlines
warn-hull-pieces = the hull is in pieces: only the largest was kept, and { $left_out } of the volume left out; look where the outlines cut the body through
warn-incomplete = a large part of the body is missing on the surface: look at the outlines
warn-kept-body = outlines have body on { $names } where a learned sense of a person sees none: look at these outlines
warn-light = the surface holds { $holds }, a body of { $weight } fills about { $fills }: { $missing } of the volume are missing; look at the outlines, and check scale and weight
warn-lost-arm = outlines leave out an arm or a part of it on { $names }, where a learned sense of a person sees it: look at these outlines
warn-lost-head = outlines leave out the head or a part of it on { $names }, where a learned sense of a person sees it: look at these outlines
warn-lost-leg = outlines leave out a leg or a part of it on { $names }, where a learned sense of a person sees it: look at these outlines
warn-lost-trunk = outlines leave out a part of the trunk on { $names }, where a learned sense of a person sees it: look at these outlines
warn-mat-about = the mat was recognised: { $count } tags, numbers { $first } to { $last }, on a ring with a radius of { $radius }, exact to { $open } ({ $share } of all lengths); for exact lengths print a mat of which the file is at hand (tags { $first } to { $last })
warn-mat-no-ring = the tags in the photos are not laid out as on a mat of tailor: the tags are not used
warn-mat-odd = the tags are on a ring with a radius of { $radius } if they are { $tag } mm wide, and no mat of tailor is like that: measure a printed tag again; the tags are not used
warn-mostly-lost = { $count } of { $of } outlines leave out a part of the body that this needs: correct these outlines, or take a photo of the empty scene as the plate
warn-no-day = the photos have no date, so the day of the capture is unknown: give it
warn-no-focal = the focal length is unknown and the photos hardly show it: give it above
warn-no-legs = the surface shows no two legs: is the body cut off, or do outlines lack a leg? Place the feet apart, without coat or skirt
warn-no-unit = the file does not give its unit: lengths are relative
warn-not-read = { $files }: not read; if they belong to the turn, convert them: { $way }
warn-outline-cuts = the outline on { $names } cuts away up to { $share } of what nearly all other photos show as body: look at this outline; correct it, or leave the photo out
warn-outlines = the outlines of some photos contradict those of all other photos: look at these outlines
warn-page-weight = the report has { $size }, more than { $most }
warn-points-few = the two points of the known length are seen in { $count } photos with a camera, from too much the same side: point at them in photos that were taken some steps apart; the length was passed over
warn-points-miss = the two points of the known length miss each other by { $off } from photo to photo: are they the same two in each, in the same order, and do they move with the subject? The length was passed over
warn-points-photo = the two points of the known length are given for { $name }, which is no photo of the capture, or one without a camera; the length was passed over
warn-points-unsure = the length between the two points is sure to { $sigma } only: point at two that are farther apart, in more photos; the length was passed over
warn-reference = a known length of the kind { $kind } is not known here
warn-rim-few = only { $count } observations of the tags on the disk’s rim are good for anything: check the light on the rim, and that it is in view
warn-rim-off = the tags on the disk’s rim are { $rim } from where they should be, those on the disk { $mat }: they were left out; measure a printed tag and the disk
warn-same-colours = subject and background have nearly the same colours there; look at the outlines
warn-scan = { $name } is taken as { $unit } with { $axis } up, { $height } tall: is that right?
warn-short = the surface is { $height } high, the stature was given as { $stature }: { $missing } of the height are missing; look whether the outlines have legs and head
warn-shortened = tapes and their intervals are shortened by { $by } %, as given
warn-swayed = the subject moved against the disk: lens and steps were mostly kept as the photos have them or as given, and how exact the cameras are is unknown
warn-tags-mat = they are laid out as on a mat of tailor ({ $count } tags on a ring of { $ring } times a tag’s size): measure the edge of a printed tag’s black square, such as 60 mm, and give it above as “Tag of the mat”
warn-tags-strange = they are not laid out as on a mat of tailor: cover them
warn-tags-unused = tags (numbers { $first } to { $last }) are seen on { $seen } of { $photos } photos that were searched, but their size is not given, so they are not used; { $layout }
warn-too-many = { $count } photos are more than are of use: the sharpest of each of { $most } even stretches is taken; steps between them are no longer even
warn-turning-focal = the focal length is unknown: { $focal }, as of phones’ main cameras, was taken; give it, if you know it
warn-two-tags = two sizes of a tag were given, { $mat } and { $reference } mm: the first was taken; measure a printed tag and correct the other
warn-two-turns = { $pause } passed between { $last } and { $first }, and { $usual } between all other photos: are these two turns? Make a capture of each
warn-unlike = the outline is not what the other photos show; look at the outlines
warn-video-steps = the frames of a video are not at even steps, so the steps of the turn were not used
warn-wide-mat = the tags of the mat reach { $reach } from the disk’s middle, but the disk ends at { $disk }: measure a printed tag, the ring and the disk, and correct what is wrong
warn-wide-rim = the strip on the rim has a radius of { $rim }, the disk one of { $disk }: measure the disk, and correct what is wrong
