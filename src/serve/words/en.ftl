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
