# Was die Seiten von `tailor serve` sagen. words/en.ftl hat dieselben Schlüssel, ein Test hält es.

skip = Zum Inhalt
settings = Sprache und Einheit
privacy = Alles bleibt auf diesem Rechner: Nichts wird irgendwohin geschickt.
to-start = Alle Aufnahmen
wrong-title = Das ging nicht

# Die erste Seite
home-title = Ein Körper, aus Fotos gemessen
home-about = Aus Fotos einer vollen Drehung werden Umfänge, jeder mit einem Intervall, und ein Bericht. So wird aufgenommen: zuerst die leere Szene, dann alle 10° bis 20° ein Foto, während die Person sich dreht und die Kamera steht; enge, gemusterte Kleidung, die Arme vom Körper weg.
drop-title = Eine neue Aufnahme
drop-hint = Die Fotos einer Drehung hierher ziehen, oder ein Video, oder Ordner mit Aufnahmen; oder auswählen.
drop-name = Wie sie heißt
drop-files = Fotos oder ein Video
drop-folder = Oder ein Ordner
drop-folder-hint = Enthält ein Ordner mehrere Aufnahmen, wird jeder Ordner eine eigene. Die Fotos folgen einander nach ihren Namen; eines, das plate.jpg heißt, zeigt die leere Szene.
drop-sending = { $done } von { $of } Dateien sind da
drop-looking = Alle Dateien sind da; sie werden angesehen …
drop-large = { $name } ist größer als { $most } MB; mehr wird nicht angenommen
drop-lost = Das Programm antwortet nicht. Läuft es noch? Neu starten und die Adresse öffnen, die es ausgibt.
drop-none = Unter diesen Dateien ist kein Foto und kein Video.
needs-script = Fotos zu senden braucht JavaScript; alles andere geht ohne.
history-title = Aufnahmen
history-none = Noch keine.
column-name = Aufnahme
column-time = Wann
column-state = Stand
column-delete = Löschen
column-girth = Umfang
column-tape = Mit Maßband
column-interval = In neun von zehn Fällen
delete = Löschen
measure-all = Alle noch nicht gemessenen messen
all-csv = Alle Umfänge als CSV
photos-count = { $count ->
    [one] eine Datei
   *[other] { $count } Dateien
}
unnamed = Ohne Namen
phone-title = Vom Telefon im selben Netz
phone-about = Diese Adresse auf dem Telefon öffnen oder dessen Kamera auf den Code richten. Wer die Adresse hat, darf diese Seite benutzen. Was gesendet wird, können andere in diesem Netz mitlesen: nur in einem vertrauten Netz benutzen.

# Eine Aufnahme
delete-capture = Diese Aufnahme endgültig löschen
seen-title = Die Fotos
seen-none = Die Fotos werden angesehen …
seen-well = Nichts Auffälliges.
look = Fotos ansehen
focal-unknown = Brennweite unbekannt
plate-there = mit leerer Szene
plate-none = ohne leere Szene
camera-stood = die Kamera stand still
camera-moved = die Kamera bewegte sich
grade-stop = So geht es nicht:
grade-doubt = Zweifel:
grade-hint = Hinweis:
can-cameras = Kameras
can-lengths = Längen
can-girths = Umfänge
photo-place = Foto { $number }: { $name }
photo-odd = hier nachsehen
photo-sharp = Schärfe
photo-light = Belichtung
photo-burnt = Überbelichtet
photo-step = Schritt zum nächsten
photo-tags = Marken
photo-remove = Weglassen
photo-remove-this = { $name } weglassen

facts-title = Was bekannt ist
facts-about = Für Zentimeter muss eine Länge bekannt sein: die Körpergröße, eine gedruckte Matte mit Marken oder die Drehscheibe. Alles andere darf leer bleiben.
facts-keep = Übernehmen
facts-wrong = Etwas stimmt nicht; siehe die markierten Felder.
fact-stature-cm = Körpergröße
hint-stature-cm = Ohne Schuhe. Ohne Matte kommen die Zentimeter daher.
fact-mat-tag-mm = Marke der Matte
hint-mat-tag-mm = Kante des schwarzen Quadrats einer Marke, am Druck gemessen.
fact-disk-diameter-cm = Drehscheibe
hint-disk-diameter-cm = Durchmesser der Drehscheibe.
fact-weight-kg = Gewicht
hint-weight-kg = Für den Body-Mass-Index.
fact-steps = Schritte einer vollen Drehung
hint-steps = 18 heißt alle 20° ein Foto; mit Minus, wenn sich die Person von oben gesehen im Uhrzeigersinn drehte.
fact-focal-mm = Brennweite
hint-focal-mm = Wie bei Kleinbild, falls die Fotos es nicht sagen.
fact-plate = Foto der leeren Szene
fact-plate-none = Keines
hint-plate = Dieselbe Szene ohne die Person: Damit werden die Umrisse besser.
fact-walk = Die Kamera wurde um eine stehende Person herumgetragen
fact-quick = Ein erster Blick: gröber und schneller
slip-number = Das ist keine Zahl.
slip-whole = Nur ganze Schritte zählen.
slip-range = Das muss zwischen { $least } und { $most } liegen.

# Messen
measuring-title = Messen
measure = Messen
measure-on = Weiter messen
measure-again = Noch einmal messen
measure-stopped = Aus diesen Fotos wird so nichts: siehe unten.
stop = Anhalten
state-none = Noch nicht gemessen.
state-waiting = Wartet, bis eine andere Aufnahme gemessen ist.
state-running = Wird gemessen
state-done = Gemessen
state-failed = Es ist nichts daraus geworden
state-stopped = Angehalten. Was fertig ist, bleibt; von dort geht es weiter.
state-interrupted = Unterbrochen: Das Programm wurde während des Messens beendet. Was fertig ist, bleibt; von dort geht es weiter.
part-photos = Fotos
part-cameras = Kameras
part-masks = Umrisse
part-hull = Hülle
part-surface = Oberfläche
part-girths = Umfänge
part-report = Bericht
step-open = wartet
step-begun = begonnen
step-running = läuft
step-done = fertig
step-failed = misslungen
step-stopped = angehalten
time-left = Noch etwa { $time }, nach dem letzten Mal
picture-placed = Wo die Kameras standen
picture-masks = Umrisse der Person
picture-hull = Was alle Umrisse übrig lassen
picture-body = Die Oberfläche
warnings = { $count ->
    [one] Eines sollte man wissen
   *[other] { $count } Dinge sollte man wissen
}

# Ergebnisse
result-title = Umfänge
result-relative = Keine Länge war bekannt, darum sind dies Verhältnisse: 1 ist der Abstand der Kamera von der Drehachse. Die Körpergröße oder eine andere Länge angeben und noch einmal messen: Das dauert Sekunden.
report = Bericht öffnen
downloads = Dateien zum Behalten
girth-WC = Taille
girth-HC = Hüfte
girth-CC = Brust
girth-NC = Hals
girth-AC-L = Oberarm links
girth-AC-R = Oberarm rechts
girth-TC-L = Oberschenkel links
girth-TC-R = Oberschenkel rechts
girth-WHR = Taille zu Hüfte
girth-WHtR = Taille zu Körpergröße

# Löschen
delete-title = { $name } endgültig löschen?
delete-about = Das lässt sich nicht rückgängig machen. Es verschwinden:
delete-files = { $count ->
    [one] eine übergebene Datei ({ $size } MB)
   *[other] { $count } übergebene Dateien ({ $size } MB)
}
delete-results = die Umfänge, der Bericht und die Oberfläche
delete-cache = alles, was im Zwischenspeicher aus diesen Fotos berechnet wurde
delete-yes = Endgültig löschen
delete-no = Behalten
gone-title = { $name } ist gelöscht
gone-results = { $count ->
    [one] ein Ergebnis im Zwischenspeicher ({ $size } MB)
   *[other] { $count } Ergebnisse im Zwischenspeicher ({ $size } MB)
}
gone-shared = Eine andere Aufnahme hatte dieselben Fotos: Was von ihren Ergebnissen verschwand, wird beim Messen neu gemacht.

# Was schiefgehen kann
wrong-missing = Das ist hier nicht (mehr).
wrong-said = { $why }
wrong-broken = Das konnte das Programm nicht: { $why }
wrong-full = Die Platte ist voll: Platz schaffen und noch einmal versuchen. Nichts halb Geschriebenes blieb zurück.
wrong-busy = Gerade wird etwas gemessen: anhalten oder warten, bis es fertig ist.
wrong-large = Das sind mehr als { $most } MB; mehr wird nicht angenommen.
wrong-many = Eine Aufnahme hat höchstens { $most } Dateien.
wrong-kind = Das ist weder ein Foto (JPEG, PNG, TIFF) noch ein Video (MP4, MOV, MKV, AVI).
wrong-header = Dieses Foto ist beschädigt: { $why }
wrong-pixels = Dieses Bild will { $width } × { $height } Pixel haben; höchstens { $most } Millionen werden gelesen.
wrong-slow = Eine Minute lang kam nichts mehr: noch einmal senden.
refused-host = Dieser Name führt zu tailor, ist aber nicht sein eigener: die Adresse öffnen, die das Programm ausgibt.
refused-origin = Eine andere Seite wollte das; nur tailors eigene dürfen es.
refused-token = Dieser Browser ist hier nicht bekannt: die Adresse öffnen, die das Programm ausgibt, mit ihrer Kennung.

# Der Pinsel
brush-open = Umrisse korrigieren
brush-title = Umrisse
brush-about = Was dunkel ist, gilt als Raum. Körper malen, wo Körper fehlt; Raum, wo zu viel genommen wurde. Mit der Tastatur: Pfeile bewegen den Pinsel, die Leertaste malt, Plus und Minus ändern seine Größe.
brush-photo = Foto
brush-paint = Pinsel
brush-body = Körper
brush-room = Raum
brush-clear = Wie gefunden
brush-size = Größe
brush-undo = Rückgängig
brush-save = Diesen Umriss behalten
brush-saved = Behalten. Den nächsten malen oder noch einmal messen: Nur was nach den Umrissen kommt, wird neu gemacht.
brush-lost = Dieser Umriss wurde nicht behalten: { $why }
brush-none = Nichts wurde gemalt.
brush-canvas = Foto mit seinem Umriss; mit Maus, Finger oder Tasten zu bemalen
brush-measured = Umrisse wurden korrigiert.
brush-forget = Alle Korrekturen zurücknehmen
brush-nothing = Es gibt noch keine Umrisse: erst messen. Umrisse eines Videos lassen sich hier nicht korrigieren.

# Was `doctor` findet (findings.rs)
find-moved = nur { $a } % des Bildes stehen still: Die Kamera oder alles hinter der Person bewegte sich zwischen den Fotos
find-moved-mend = für eine Drehung gehört die Kamera auf ein Stativ und die Person auf eine Drehscheibe; wurde die Kamera um eine stehende Person herumgetragen? Dann oben angeben
find-shuffled = Fotos ähneln weit entfernten mehr als ihren Nachbarn: Sie folgen nicht der Drehung
find-shuffled-mend = die Fotos in der Reihenfolge der Drehung benennen und noch einmal übergeben
find-stranger = ähnelt einem weit entfernten weit mehr als seinen Nachbarn
find-stranger-mend = nachsehen, ob diese Fotos an ihrem Platz sind
find-same = zwischen diesen Fotos und dem nächsten drehte sich nichts
find-same-mend = von je zweien eines weglassen
find-gap = das nächste Foto unterscheidet sich weit mehr als sonst
find-gap-mend = nachsehen, ob dort ein Foto fehlt
find-blurred = unscharf neben den anderen
find-blurred-mend = noch einmal aufnehmen oder weglassen
find-burnt = auf einem Zehntel des Bildes oder mehr überbelichtet
find-black = auf einem Zehntel des Bildes oder mehr schwarz
find-lost-mend = mit fester Belichtung noch einmal aufnehmen
find-uneven = von { $a } bis { $b } EV gegen die mittlere belichtet
find-uneven-mend = Belichtung und Weißabgleich festhalten (am Telefon: gedrückt halten, bis AE/AF-Sperre erscheint)
find-pixels = Fotos von { $a } × { $b } Pixeln sind klein
find-pixels-mend = die Dateien übergeben, wie die Kamera sie schrieb
find-head = was sich bewegt, reicht an den oberen Rand: Der Kopf ist vielleicht abgeschnitten
find-head-mend = über dem Kopf Platz lassen
find-arms = was sich bewegt, reicht an beide Seiten: Arme sind vielleicht abgeschnitten, oder hinter der Person gehen andere
find-arms-mend = zurücktreten und den Hintergrund ruhig halten
find-mat = eine Matte ist angegeben, aber keine ihrer Marken wurde gefunden
find-mat-mend = ist sie im Bild, gut beleuchtet und flach?
find-few = { $a } Fotos sind wenige: Ohne Matte werden Merkmale über höchstens 30° verfolgt
find-few-mend = 18 bis 36 Fotos einer vollen Drehung aufnehmen oder eine Matte auf die Scheibe legen
find-focal = nichts verrät die Brennweite
find-focal-mend = EXIF in den Fotos lassen oder die Brennweite oben angeben
find-length = keine Länge ist bekannt: Längen werden relativ
find-length-mend = oben Körpergröße oder Drehscheibe angeben oder eine Matte auf die Scheibe legen
find-plate = es gibt kein Foto der leeren Szene
find-plate-mend = eines ohne die Person aufnehmen und plate.jpg nennen: Umrisse werden sicherer
find-can-stopped = so nicht: siehe oben
find-can-mat = aus der Matte, Foto für Foto
find-can-features = aus dem, was sich mit der Person dreht: gemusterte Kleidung, ein gemustertes Tuch auf der Scheibe
find-can-walked = nicht als Drehung
find-can-cm = in Zentimetern, aus: { $a }
find-can-relative = relativ: Verhältnisse stimmen, keine Zentimeter
find-can-no = nein
find-can-bmi = ja, mit Verhältnissen und Body-Mass-Index
find-can-ratios = ja, mit Verhältnissen; der Body-Mass-Index braucht Gewicht und Körpergröße
find-from-mat = Matte mit Marken
find-from-reference = bekannte Länge
find-from-disk = Durchmesser der Scheibe, falls ihr Rand zu sehen ist
find-from-stature = Körpergröße
