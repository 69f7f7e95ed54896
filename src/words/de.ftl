# Was das Programm sagt: die Seiten von `tailor serve`, der erste Bildschirm von `tailor measure`. en.ftl hat dieselben Schlüssel, ein Test hält es.

skip = Zum Inhalt
settings = Sprache und Einheit
privacy = Alles bleibt auf diesem Rechner: Nichts wird irgendwohin geschickt.
to-start = Alle Aufnahmen
wrong-title = Das ging nicht

# Die erste Seite
home-title = Ein Körper, aus Fotos gemessen
home-about = Aus Fotos einer vollen Drehung werden Umfänge, jeder mit einem Intervall, und ein Bericht. So wird aufgenommen: zuerst die leere Szene, dann alle 10° bis 20° ein Foto, während die Person sich dreht und die Kamera steht; eng anliegende Kleidung, am besten gemustert, oder Unterwäsche; die Haare hoch, die Arme vom Körper weg.
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
column-tape = Maßband
column-interval = 90-%-Intervall
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
photo-taken = Aufgenommen
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
facts-stale = Nicht übernommen: In einem anderen Fenster wurde inzwischen geändert: { $fields }. Die markierten Felder ansehen; noch einmal „Übernehmen“ ersetzt, was dort übernommen wurde.
fact-stature-cm = Körpergröße
hint-stature-cm = Ohne Schuhe. Ohne Matte kommen die Zentimeter daher.
fact-mat-tag-mm = Marke der Matte
hint-mat-tag-mm = Kante des schwarzen Quadrats einer Marke, am Druck gemessen.
fact-disk-diameter-cm = Drehscheibe
hint-disk-diameter-cm = Durchmesser der Drehscheibe.
fact-weight-kg = Gewicht
hint-weight-kg = Für den Body-Mass-Index.
fact-sex = Geschlecht
fact-sex-none = Keine Angabe
fact-sex-female = Weiblich
fact-sex-male = Männlich
hint-sex = Für Vergleichswerte: Schwellen für Erwachsene, Wachstum von Kindern.
fact-age-years = Alter in Jahren
hint-age-years = Am Tag der Fotos; 9,5 ist neuneinhalb. Für Kinder von 5 bis 19: wo sie neben der Wachstumsreferenz der WHO stehen.
fact-steps = Schritte einer vollen Drehung
hint-steps = 18 heißt alle 20° ein Foto; mit Minus, wenn sich die Person von oben gesehen im Uhrzeigersinn drehte.
fact-focal-mm = Brennweite
hint-focal-mm = Wie bei Kleinbild, falls die Fotos es nicht sagen.
fact-plate = Foto der leeren Szene
fact-plate-none = Keines
hint-plate = Dieselbe Szene ohne die Person: Damit werden die Umrisse besser.
fact-walk = Die Kamera wurde um eine stehende Person herumgetragen
fact-quick = Ein erster Blick: gröber und schneller
fact-empty = leer
fact-on = angekreuzt
fact-off = nicht angekreuzt
slip-number = Das ist keine Zahl.
slip-whole = Nur ganze Schritte zählen.
slip-range = Das muss zwischen { $least } und { $most } liegen.
slip-stale = Inzwischen: { $now }. Noch einmal übernehmen, um Ihre Eingabe zu benutzen.

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
state-nothing = Kein Umfang ließ sich messen
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
result-none = Kein Umfang ließ sich messen; die Gründe stehen unten.
result-missing = { $count ->
    [one] Ein Umfang ließ sich nicht messen
   *[other] { $count } Umfänge ließen sich nicht messen
}
result-relative = Keine Länge war bekannt, darum sind dies Verhältnisse: 1 ist der Abstand der Kamera von der Drehachse. Die Körpergröße oder eine andere Länge angeben und noch einmal messen: Das dauert Sekunden.
result-disputed = Bekannte Längen widersprechen einander, darum sind dies Verhältnisse: 1 ist der Abstand der Kamera von der Drehachse. Eine davon berichtigen oder weglassen und noch einmal messen: Das dauert Sekunden.
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
girth-WC-natural = Taille, natürliche
girth-WC-narrowest = Taille, schmalste Stelle
girth-WC-navel = Taille am Nabel
girth-WC-hip-bone = Taille am Hüftknochen
girth-HC-max = Hüfte, größter Umfang
girth-AC = Oberarm, Mittel
girth-CFC-L = Wade links
girth-CFC-R = Wade rechts
girth-arms = Oberarme
girth-thighs = Oberschenkel
girth-calves = Waden
girth-stature = Körpergröße
girth-WHR = Taille zu Hüfte
girth-WHtR = Taille zu Körpergröße
girth-WHR-tape = Taille zu Hüfte, Bandmaße
girth-density-kg-l = Dichte, kg/l
result-bmi = Body-Mass-Index
result-bmi-for-age = Body-Mass-Index nach Alter, WHO 2007
result-height-for-age = Größe nach Alter, WHO 2007
result-centile = Perzentile { $centile }
result-growth = z sagt, um wie viele Standardabweichungen dieses Kind vom Median gleichen Geschlechts und Alters entfernt ist. Eine Vergleichsgröße, keine Diagnose.

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
gone-unread = Vielleicht ist nicht alles gelöscht: Diese Dateien im Zwischenspeicher hat eine neuere Version des Programms geschrieben, oder sie sind nicht lesbar. Löschen Sie sie, oder lassen Sie das Programm, das sie geschrieben hat, die Aufnahme vergessen.
gone-shared = Eine andere Aufnahme hatte dieselben Fotos: Was von ihren Ergebnissen verschwand, wird beim Messen neu gemacht.

# Was schiefgehen kann
wrong-missing = Das ist hier nicht (mehr).
wrong-json = Das ist kein gültiges JSON: { $why }
wrong-object = Erwartet wird ein JSON-Objekt, keine Liste und kein einzelner Wert.
wrong-media = JSON senden, mit dem Kopf Content-Type: application/json.
wrong-request = Diese Anfrage lässt sich nicht lesen: { $why }
wrong-method = Diese Adresse nimmt solche Anfragen nicht an.
wrong-said = { $why }
wrong-plate = In dieser Aufnahme (Dateien: { $files }) gibt es kein Foto { $number }: die Nummer eines ihrer Fotos angeben.
wrong-broken = Das konnte das Programm nicht: { $why }
wrong-full = Die Platte ist voll: Platz schaffen und noch einmal versuchen. Nichts halb Geschriebenes blieb zurück.
wrong-busy = Gerade wird etwas gemessen: anhalten oder warten, bis es fertig ist.
wrong-stale = Was bekannt ist, wurde inzwischen geändert: vor der Änderung noch einmal lesen.
wrong-large = Das sind mehr als { $most } MB; mehr wird nicht angenommen.
wrong-many = Eine Aufnahme hat höchstens { $most } Dateien.
wrong-heic = Das ist ein HEIC-Foto, das dieses Programm nicht liest. Auf dem Telefon „Maximale Kompatibilität“ wählen (iPhone: Einstellungen, Kamera, Formate) und die Fotos als JPEG aufnehmen oder senden, oder sie umwandeln: heif-convert EIN.heic AUS.jpg
wrong-kind = Das ist weder ein Foto (JPEG, PNG, TIFF) noch ein Video (MP4, MOV, MKV, AVI).
wrong-header = Dieses Foto ist beschädigt: { $why }
wrong-pixels = Dieses Bild will { $width } × { $height } Pixel haben; höchstens { $most } Millionen werden gelesen.
wrong-slow = Eine Minute lang kam nichts mehr: noch einmal senden.
refused-host = Dieser Name führt zu tailor, ist aber nicht sein eigener: die Adresse öffnen, die das Programm ausgibt.
refused-origin = Eine andere Seite wollte das; nur tailors eigene dürfen es.
refused-address = Eine andere Seite hat diese Adresse geöffnet; das lehnt tailor zur Sicherheit ab. Einen neuen Tab öffnen und die Adresse, die das Programm ausgibt, in die Adresszeile kopieren.
refused-token = Dieser Browser ist hier nicht bekannt: die Adresse öffnen, die das Programm ausgibt, mit ihrer Kennung.

# Der Pinsel
brush-open = Umrisse korrigieren
brush-title = Umrisse
brush-about = Dunkle Bereiche gelten als Hintergrund. „Körper“ malen, wo vom Körper etwas fehlt, „Hintergrund“, wo zu viel enthalten ist. Mit der Tastatur: Pfeile bewegen den Pinsel, die Leertaste malt, Plus und Minus ändern seine Größe.
brush-photo = Foto
brush-paint = Pinsel
brush-body = Körper
brush-room = Hintergrund
brush-clear = Wie gefunden
brush-size = Größe
brush-undo = Rückgängig
brush-save = Diesen Umriss behalten
brush-saved = Behalten. Den nächsten malen oder noch einmal messen: Nur was nach den Umrissen kommt, wird neu gemacht.
brush-lost = Dieser Umriss wurde nicht behalten: { $why }
brush-none = Nichts wurde gemalt.
brush-unkept = Noch nicht behalten: { $photos }
brush-canvas = Foto mit seinem Umriss; mit Maus, Finger oder Tasten zu bemalen
brush-measured = Umrisse wurden korrigiert.
brush-forget = Alle Korrekturen zurücknehmen
brush-nothing = Es gibt noch keine Umrisse: erst messen. Umrisse eines Videos lassen sich hier nicht korrigieren.

# Der erste Bildschirm von `tailor measure`
screen-found = { $count ->
    [one] ein Foto mit { $size } Megapixeln
   *[other] { $count } Fotos mit je { $size } Megapixeln
}
screen-own-masks = Masken ihres Ordners
screen-video = aus einem Video
screen-scan = eine Oberfläche aus einer Datei
screen-mat = eine Matte mit { $count } Marken
screen-mat-some = eine Matte mit Marken
screen-over = { $step }: fertig
screen-cached = { $step }: schon im Zwischenspeicher
screen-left = noch etwa { $time }
screen-first = erste Antwort, unten genauer: { $girths }
screen-none = weder Taille noch Hüfte
screen-first-report = erster Bericht: { $path }
screen-cameras = { $name }: { $with } von { $of } Fotos haben eine Kamera
screen-lengths = Längen kommen von: { $from } (± { $percent } %)
screen-lengths-unsure = Längen kommen von: { $from } (wie sicher: unbekannt)
screen-from-mat = Matte mit Marken
screen-from-tags = Marken bekannter Größe
screen-from-reference = bekannte Länge
screen-from-disk = Durchmesser der Scheibe
screen-from-stature = Körpergröße
screen-given = übergebene Kameras
screen-relative = LÄNGEN SIND RELATIV, denn keine Länge war bekannt: Verhältnisse stimmen, und 1 ist der Abstand der Kamera von der Drehachse
screen-disputed = LÄNGEN SIND RELATIV, denn bekannte Längen widersprechen einander (siehe unten): Verhältnisse stimmen, und 1 ist der Abstand der Kamera von der Drehachse
screen-girth = Umfang
screen-tape = Band { $unit }
screen-tape-relative = relativ
screen-interval = Bereich (90 %)
screen-contour = Kontur
screen-range = { $low } bis { $high }
screen-unknown = unbekannt: { $parts }
screen-shortened = Bandmaße sind um { $percent } % verkürzt, wie compression_pct angibt
screen-child = z, WHO 2007; Perzentile { $centile }; keine Diagnose
screen-missing = nicht gemessen
screen-warnings = { $count ->
    [one] 1 Warnung
   *[other] { $count } Warnungen
}
screen-again = Wiederholen
screen-files = alle Dateien: { $path }
screen-report = Bericht:      { $path }

# `tailor doctor`
mat-next = zu 100 % drucken und prüfen, dass das Lineal 100 mm lang ist
    die Zeilen für capture.toml stehen am Fuß jeder Seite und in { $facts }; oder: tailor measure ORDNER --mat { $print }
mat-tags = Marken
mat-tag-size = Größe einer Marke
mat-tags-on-the-rim = Marken am Rand
mat-their-size = deren Größe
mat-ring-radius = Radius des Rings
doctor-photos = { $count ->
    [one] ein Foto mit { $size } Pixeln
   *[other] { $count } Fotos mit { $size } Pixeln
}
doctor-plate = mit leerer Szene ({ $name })
doctor-no-plate = kein Foto der leeren Szene
doctor-stood = die Kamera bewegte sich nicht ({ $still } % des Bildes bleiben gleich)
doctor-moved = die Kamera bewegte sich ({ $still } % des Bildes bleiben gleich)
doctor-noise-plate = Rauschen: { $levels } Graustufen (Fotos gegen das der leeren Szene)
doctor-noise-neighbours = Rauschen: { $levels } Graustufen (Fotos gegen ihre Nachbarn, wo sich nichts bewegte)
doctor-noise-none = Rauschen: nicht gemessen (keine zwei Bilder zeigen dasselbe)
doctor-odd = Was auffällt
doctor-stop = so nicht
doctor-doubt = Zweifel
doctor-hint = Hinweis
doctor-can = Was sich messen lässt
doctor-cameras = Kameras
doctor-lengths = Längen
doctor-girths = Umfänge
doctor-turning = Drehung

# Was nur die Befehlszeile meldet, mit ihren Schaltern und Dateien
cli-cache-disk = der Zwischenspeicher in { $path }: { $why }; Platz schaffen, beschreibbar machen oder mit --cache einen anderen angeben
cli-cache-format = der Zwischenspeicher in { $root } ist anders aufgebaut ({ $found }): Eine andere Version des Programms hat ihn angelegt; diese benutzen oder mit --cache einen anderen Ordner angeben
cli-cache-strange = { $root } ist nicht leer und kein Zwischenspeicher ({ $strange } gehört zu keinem): Nichts wurde geschrieben; mit --cache einen anderen oder einen leeren Ordner angeben
cli-captures = { $some } von { $all } Aufnahmen wurden nichts: { $folders }
cli-convert = in { $folder } ist kein Foto, das gelesen werden kann ({ $known }). Umwandeln, was da ist:{ $ways }
cli-convert-way = {"\u000A"}  { $files }: ({ $way }){ $more }
cli-flag-centre = { $flag } { $text }: X,Y angeben, etwa 804.8,1191
cli-flag-fact = { $flag } { $text }: SCHLÜSSEL=WERT angeben, etwa subject.height_cm=178
cli-flag-ids = { $flag } { $text }: ERSTE-LETZTE angeben, etwa 0-11
cli-flag-length = { $flag } { $text }: { $why }
cli-flag-reference = { $flag } { $text }: ART=LÄNGE angeben, etwa subject_height=165cm
cli-flag-seen = { $flag } { $text }: FOTO=X1,Y1,X2,Y2 angeben, etwa IMG_1.jpg=812,3011,1420,3055
cli-flag-steps = { $flag }: wie viele gleiche Schritte hat die volle Drehung?
cli-flag-twice = { $flag } { $text }: { $photo } kam schon vor; jedes Foto einmal angeben
cli-folder-no-video = in { $folder } ist kein Video (mp4, mov, mkv, …)
cli-images-lead-out = `images` ist { $pattern } und führt aus { $folder } hinaus: Fotos müssen im Ordner selbst oder in Ordnern darin sein
cli-init-file = { $file } ist eine Datei: den Ordner angeben, in den capture.toml geschrieben wird
cli-init-there = { $file } gibt es schon und blieb, wie es war
cli-input = Eingabe { $name }: { $why }
cli-input-control = { $path } hat Steuerzeichen im Namen; ihm einen anderen geben
cli-input-empty = in { $path } passt keine Datei zu { $patterns }
cli-input-unreadable = { $path }: { $why }; einen Ordner angeben, den es gibt und der lesbar ist
cli-input-utf8 = der Name von { $path } ist kein UTF-8; ihm einen anderen geben
cli-masks-inverted = { $name } sieht umgekehrt aus: Am Rand ist der Ton, der auf den anderen Masken der Körper ist; umkehren, oder `body` setzen, wenn die Person die Fotos füllt
cli-mat-ending = { $file }: eine Matte wird als .pdf oder .svg geschrieben; der Datei eine dieser Endungen geben
cli-no-age = { $text } ist kein Alter wie 9.5, 9y6mo oder 114mo
cli-no-length = { $text } ist keine Länge wie 178, 178cm, 1.78m, 70in oder 5ft10in
cli-no-number = { $text } ist keine Zahl
cli-no-weight = { $text } ist kein Gewicht wie 80, 80kg oder 176lb
cli-no-whole-number = { $text } ist keine ganze Zahl
cli-not-written = { $file } kann nicht geschrieben werden: { $why }
cli-of-photos = { $flag }: gilt für Fotos; zu einer Oberfläche gehören --unit-of-file und --up
cli-one-capture = eine Aufnahme auf einmal: einen Ordner angeben
cli-out-disk = { $path }: { $why }
cli-out-inside = { $out } ist in { $folder }; was dort geschrieben wird, würde beim nächsten Mal als Eingabe gelesen: mit --out einen Ordner außerhalb angeben
cli-out-link = { $path } ist ein Verweis, und durch einen Verweis wird nichts geschrieben: ihn entfernen oder einen anderen Ordner angeben
cli-out-name = { $path } ist kein Name einer Datei in einem Ordner mit Ergebnissen
cli-out-no-folder = { $path } ist kein Ordner; mit --out einen anderen angeben
cli-profile = --profile ist für einen Lauf: einen Ordner angeben
cli-result-gone = das Ergebnis von { $node } ging aus dem Zwischenspeicher verloren, bevor es geschrieben war: denselben Befehl noch einmal geben
cli-same-place = { $one } und { $other } kämen beide nach { $place }: nacheinander messen, jede mit eigenem --out
cli-scan-size = { $name } ist { $high_mm } hoch, wenn seine Zahlen { $unit } sind: `unit` setzen, oder `up`, wenn eine andere Achse nach oben zeigt
cli-stopped = angehalten; mit demselben Befehl geht es weiter

# Meldungen nach ihren Codes; auf Seiten gibt es Felder und Umrisse, keine Schalter, Dateien und Masken.
fail-adrift = { $few } von { $of } Fotos haben weniger als { $least } Merkmale ({ $names }), so dass nichts sagt, wo ihre Kameras standen: Sind sie in der Reihenfolge der Drehung, in Schritten unter 30°? Ging die Kamera um eine stehende Person herum (dann das angeben)? Ein gemustertes Tuch oder eine gedruckte Markenmatte auf der Scheibe hilft
fail-all-differs = { $name }: Fast alles darin unterscheidet sich von der leeren Szene: Wurde die Kamera bewegt oder das Licht geändert, während die Fotos aufgenommen wurden?
fail-apart = die Fotos haben zu wenige Merkmale gemeinsam, die sich mit der Scheibe drehen ({ $pairs } von { $of } benachbarten Fotos haben genug): ein gemustertes Tuch oder eine gedruckte Markenmatte auf die Scheibe legen oder in kleineren Schritten fotografieren
fail-bug = ein Programmfehler: Es brach ab; was getan ist, bleibt erhalten
fail-contradict = zwei Längenangaben ({ $first }; { $other }) widersprechen einander um { $off }, so dass nichts sagt, wie groß der Körper ist: Eine ist falsch (berichtigen oder die unsicherere weglassen), oder den Umrissen fehlen Beine oder Kopf, oder die Kameras stimmen nicht (mehr Fotos aufnehmen oder eine Matte auf die Scheibe legen)
fail-copies = nur { $found } von { $files } Fotos sind verschieden, eine Drehung braucht aber mindestens { $least }; Kopien eines anderen Fotos: { $copies }; jedes Foto einmal übergeben
fail-count = angegeben sind { $promised } Fotos, es gibt aber { $found }{ $copies }: die fehlenden hinzufügen oder die Zahl berichtigen
fail-few-no-mat = es gibt { $count } Fotos: Ohne Markenmatte werden Merkmale von Foto zu Foto verfolgt, und das braucht eine volle Drehung in Schritten von höchstens 30°; 18 bis 36 Fotos aufnehmen, oder eine gedruckte Matte auf die Scheibe legen und die Größe ihrer Marken angeben, oder die Schritte der vollen Drehung angeben
fail-few-photos = Fotos in der Reihenfolge der Drehung: { $found }, eine Drehung braucht aber mindestens { $least }: die übrigen Fotos der Drehung hinzufügen
fail-misplaced = { $count ->
    [one] Ein Foto ist
   *[other] { $count } Fotos sind
} nicht in der Reihenfolge der Drehung ({ $names }): { $photo } zeigt, was zwischen { $before } und { $after } liegt; die Fotos in ihre Reihenfolge umbenennen oder weglassen
fail-folded = { $pairs } von { $of } Paaren von Fotos, die näher als { $apart } beieinander liegen, haben weniger als { $least } Merkmale gemeinsam, also wurden verschiedene Seiten des Körpers aufeinander gelegt: die Fotos in die Reihenfolge der Drehung bringen oder eine gedruckte Markenmatte auf die Scheibe legen; hat sich die Person auf der Stelle gedreht, ohne Scheibe (dann das angeben)?
fail-folder = { $folder }: { $why }; einen Ordner angeben, den es gibt und der lesbar ist
fail-hopeless = { $why }
fail-hull-contradicted = kein Punkt des Raums ist auf allen Fotos Körper: Der Umriss auf { $names } schneidet bis zu { $percent } von dem weg, was fast alle anderen zeigen; diesen Umriss ansehen, berichtigen oder das Foto weglassen
fail-hull-few = nur { $count } Fotos haben sowohl einen Umriss als auch eine Kamera, eine Hülle braucht aber mindestens 3
fail-hull-memory = Zellen von { $voxel_mm } mm bräuchten etwa { $need } Speicher, aber nur { $most } dürfen belegt werden: Stimmt der Maßstab (Körpergröße, Matte, Scheibe)? Eine erste Ansicht nimmt gröbere Zellen
fail-hull-nothing = kein Punkt des Raums ist auf { $share } der Fotos Körper: Gehören Umrisse und Kameras zusammen? Die Umrisse ansehen
fail-look-gone = was zu sehen war, ist nicht mehr im Zwischenspeicher: noch einmal ansehen
fail-loose = Merkmale liegen { $rms } neben ihrem Platz (bis { $most } ist zu trauen), also ist den Kameras nicht zu trauen: zu wenig Struktur, eine Person, die sich bewegt hat, Fotos nicht in der Reihenfolge der Drehung oder beschnitten, oder eine Kamera, die herumging (dann das angeben); ein gemustertes Tuch oder eine gedruckte Markenmatte auf die Scheibe legen
fail-mask-empty = der Umriss von { $name } ist { $what }: ihn berichtigen oder entfernen
fail-mat-beyond = die Familie 36h11 hat die Marken 0 bis 586: { $id } gibt es nicht
fail-mat-crowded = { $count } Marken von { $tag_mm } mm passen nicht auf eine Scheibe von { $disk_mm } mm: höchstens { $most }; weniger oder kleinere nehmen
fail-mat-misfit = die Matte passt nicht zu dem, was angegeben ist: Ihre Marken liegen { $rms } neben ihrem Platz; eine gedruckte Marke noch einmal messen
fail-mat-rim = { $count } Marken gehen nicht um den Rand: mindestens 3 und höchstens { $most }
fail-mat-thin = Marken von { $tag_mm } mm passen nicht auf einen Rand von { $thick_mm } mm: um jede muss ein Achtel ihrer Größe weiß sein, mindestens 5 mm, und keine darf größer als ein Drittel des Radius der Scheibe sein
fail-mat-unseen = nur { $seen } von { $of } Fotos zeigen zwei Marken der Matte: das Licht auf der Scheibe, den Bildausschnitt und die Größe einer Marke prüfen
fail-mixed-sizes = die Fotos sind verschieden groß, aber eine einzige Kamera muss die ganze Drehung aufnehmen, ohne Zuschnitt: { $most } sind { $size }, { $odd }; weglassen, was nicht zur Drehung gehört
fail-no-beginning = keine zwei Fotos haben für den Anfang genug gemeinsam: in kleineren Schritten fotografieren, mit mehr Struktur oder mit einer gedruckten Markenmatte auf der Scheibe
fail-no-body = die Oberfläche ist leer oder liegt unter dem Boden, es gibt also keinen Körper zu messen: die Umrisse ansehen
fail-no-images = als Fotos sind { $pattern } angegeben, aber { $found }: berichtigen oder weglassen{ $below }
fail-no-photos = in { $folder } sind keine Fotos (JPEG, PNG oder TIFF): die der Drehung hineinlegen
fail-no-picture = { $name } ist kein lesbares Bild ({ $why }); noch einmal als JPEG, PNG oder TIFF speichern oder weglassen
fail-no-plate = es gibt kein Foto der leeren Szene, und ohne Kameras lässt sich der Körper nicht vom Raum trennen: ein Foto derselben Szene ohne die Person aufnehmen
fail-no-ring = die Kameras liegen { $off } neben einem Ring, also ist ihnen nicht zu trauen: Ging die Kamera um eine stehende Person herum (dann das angeben)? Sind die Fotos in der Reihenfolge der Drehung und die Schritte unter 25°? Brennweite, Schritte der Drehung oder eine gedruckte Markenmatte auf der Scheibe helfen
fail-no-subject = { $name }: Nichts darin unterscheidet sich von der leeren Szene: Ist die Person darauf, oder wurde die Kamera nach dem Foto der leeren Szene bewegt?
fail-no-such-plate = als leere Szene ist { $name } angegeben, aber diese Datei gibt es nicht{ $near }: berichtigen oder weglassen (ein Foto namens plate.jpg wird auch so gefunden)
fail-no-texture = weder Marken einer angegebenen Matte noch Merkmale, die sich mit der Scheibe drehen, wurden gefunden, so dass nichts sagt, wo die Kamera stand: Sind die Fotos in der Reihenfolge der Drehung, in Schritten unter 30°? Ein gemustertes Tuch oder eine gedruckte Markenmatte auf der Scheibe hilft
fail-no-video = hier ist kein Video (mp4, mov, mkv, …)
fail-not-decoded = { $name } ist nicht lesbar: { $why }; noch einmal als JPEG, PNG oder TIFF speichern
fail-not-installed = { $name } ist auf diesem Rechner nicht installiert, und { $what } lässt sich ohne es nicht lesen: apt install { $package }
fail-not-run = { $name } lässt sich nicht starten: { $why }
fail-on-side = die Fotos liegen auf der Seite: Von der Scheibe aus liegt oben an ihrem linken oder rechten Rand. Um 90° drehen, in einem Programm, das sie so speichert
fail-one-colour = { $name } hat nur eine Farbe: noch einmal aufnehmen oder weglassen
fail-overexposed = { $name } ist fast überall überbelichtet: noch einmal aufnehmen oder weglassen
fail-photo-size = Foto { $name } hat { $photo } Pixel, seine Kamera wurde aber für { $camera } kalibriert
fail-in-view = { $why }
fail-masks-black = { $name } ist ganz schwarz und zeigt nicht, wo der Körper ist: neu zeichnen oder entfernen
fail-masks-image = { $name } ist kein lesbares Bild: { $why }; noch einmal als PNG speichern
fail-masks-named = keine der { $count } Dateien heißt wie ein Foto: den Umriss von { $photo } { $stem }.png oder { $stem }_mask.png nennen
fail-masks-size = { $name } hat { $got } Pixel, das Foto { $photo } aber { $want }: in der Größe des Fotos speichern
fail-masks-twice = { $one } und { $other } heißen beide wie der Umriss von { $photo }: einen davon behalten
fail-masks-white = { $name } ist ganz weiß und zeigt nicht, wo der Körper ist: neu zeichnen oder entfernen
fail-mat-file = { $file } beschreibt keine Matte: die Datei der gedruckten Matte angeben (.pdf, .svg oder .toml) oder die Kantenlänge des schwarzen Quadrats einer gedruckten Marke
fail-mat-unreadable = { $file }: { $why }
fail-no-folder = { $file } ist eine Datei: den Ordner mit allen Fotos der Drehung angeben, ein Video (mp4, mov, mkv, …) oder eine Oberfläche (ply, obj, stl, off, glb, 3mf)
fail-number = { $flag }: { $why }
fail-number-beyond = { $flag }: { $text } ist nicht von { $least } bis { $most }{ $unit }{ $hint }
fail-out-of-another = { $out } enthält anderes als die Ergebnisse von { $capture }: Nichts wurde geschrieben; einen anderen Ordner angeben
fail-out-of-somebody = { $file } ist nicht von tailor: Nichts wurde geschrieben; einen leeren Ordner angeben
fail-scan-count = eine Datei mit einer Oberfläche wird gebraucht, es gibt { $count }
fail-scan-empty = { $name } hat keine Flächen: Gebraucht wird ein Netz, keine Punktwolke
fail-scan-faces = { $name } hat { $faces } Flächen, mehr als 4 Millionen: auf etwa 400 000 verringern und noch einmal messen
fail-scan-fault = { $name }: { $fault }
fail-scan-read = { $name } ist nicht als Netz zu lesen: { $why }
fail-scan-two = { $name } enthält zwei große Teile, die nicht zusammenhängen: zwei Körper oder zwei Hälften? Eine Person in einem Stück in der Datei lassen
fail-photos-one-by-one = das sind Fotos eines Ordners, von denen jedes eine Aufnahme wäre: { $folder } angeben
fail-plate-moves = es gibt kein Foto der leeren Szene, und nur { $still } der Bildpunkte stehen während der Drehung still: Hat sich die Kamera bewegt? Mit fester Kamera ein Foto der leeren Szene aufnehmen
fail-program-long = { $name } wurde nach { $seconds } mit { $what } beendet: Ist die Datei viel länger als eine Drehung oder beschädigt?
fail-raw-unreadable = { $name } ist kein Rohfoto, das dcraw_emu lesen kann ({ $why }): JPEGs der Kamera übergeben oder es weglassen
fail-several-videos = es gibt { $count } Videos ({ $names }), und eine Drehung ist eines davon: nur eines übergeben, zum Beispiel { $first }
fail-surface-empty = die Oberfläche ist leer: die Umrisse ansehen
fail-surface-fault = die Oberfläche lässt sich nicht verfeinern ({ $fault }): die Umrisse ansehen
fail-surface-few = nur { $count } Fotos haben eine Kamera, eine Oberfläche braucht aber mindestens 2, die sie sehen
fail-surface-unseen = kein Teil der Oberfläche ist auf zwei Fotos zu sehen: Kameras und Umrisse ansehen
fail-turning-loose = die Umrisse widersprechen einander um { $percent } der Körperhöhe (höchstens { $most } dürfen es sein): die Kamera fest hinstellen, Arme und Kopf beim Drehen still halten, nichts Weites tragen und niemanden sonst ins Bild lassen
fail-turning-no-trunk = auf { $names } sind Schultern, Hüfte oder Kopf nicht im Bild, so dass nichts sagt, wohin der Körper schaut: die ganze Person im Bild halten oder diese Fotos weglassen
fail-turning-nobody = nur { $seen } von { $of } Fotos zeigen, wer sich dreht (mindestens { $least } müssen es): Ist es eine Person, ganz und allein im Bild, und ist es hell genug?
fail-turning-open = zwischen { $before } und { $after } hat sich der Körper um { $degrees } ohne Foto gedreht (höchstens { $most } dürfen es sein): sich langsam einmal ganz herum drehen und alle 15° ein Foto aufnehmen
fail-turning-upside-down = die Person steht auf den Fotos auf dem Kopf: Fotos richtig herum drehen und noch einmal übergeben
fail-unexplained = keine Drehung um eine Achse erklärt die Merkmale: Nur { $share } passen; hat sich die Kamera bewegt (ging sie um die Person herum? dann angeben), sind die Fotos nicht in der Reihenfolge der Drehung, oder füllt der Hintergrund sie? Eine gedruckte Markenmatte auf der Scheibe hilft
fail-upside-down = die Fotos stehen auf dem Kopf: Von der Matte aus liegt oben an ihrem unteren Rand. Um 180° drehen, in einem Programm, das sie so speichert
fail-video-changes = die Bilder von { $name } ändern ab Bild { $frame } ihre Größe: eine einzige Aufnahme nehmen, nicht mehrere aneinander gehängte
fail-video-long = { $name } dauert { $minutes }, und mehr als { $most } min werden nicht durchgesehen: auf die Drehung kürzen
fail-video-no-pictures = { $name } enthält keine bewegten Bilder: das Video der Drehung nehmen
fail-video-short = { $name } hat { $frames } Bilder: Eine Drehung hat mindestens drei
fail-video-still = in { $name } dreht sich nichts: Seine { $frames } Bilder sind alle gleich
fail-video-unreadable = { $name } ist kein lesbares Video ({ $why }): Wurde es ganz kopiert?
fail-walk-apart = die Fotos hängen nicht zusammen: { $most } von { $of } haben Merkmale gemeinsam, { $rest } zu wenige mit ihnen ({ $names }): Fotos von anderem weglassen oder in kleineren Schritten fotografieren, so dass jedes Foto das meiste vom vorigen zeigt
fail-walk-border = die Person ragt über den Rand von { $count } von { $of } Fotos ({ $names }): Fotos aufnehmen, die sie ganz zeigen
fail-walk-colours = Person und Raum haben fast dieselben Farben: Neben dem Umriss liegen nur { $share } der Bildpunkte auf der Seite, die ihre Farbe sagt ({ $least } werden verlangt), die Umrisse wären also geraten: vor einem anderen Hintergrund aufnehmen
fail-walk-contradict = die Umrisse widersprechen einander: Jeder stimmt nur zu { $share } mit dem überein, was alle zusammen zeigen ({ $least } werden verlangt): Hat sich die Person bewegt, oder stand sie am Rand?
fail-walk-depth = keine zwei Fotos zeigen dasselbe von weit genug entfernten Plätzen, so dass nichts die Tiefe sagt: um die Person herumgehen, 10° bis 20° von Foto zu Foto (die Kamera auf der Stelle zu drehen hilft nicht)
fail-walk-few = nur { $found } von { $of } Fotos passen zu einer Anordnung der Kameras; { $names } und andere nicht: in kleineren Schritten fotografieren, mit genug Licht für scharfe Fotos und ohne Großes, das sich im Bild bewegt
fail-walk-lacking = { $share } der Merkmale in der Mitte der Kameras liegen in keinem Umriss (höchstens { $most } dürfen es): Ein Teil der Person hat die Farben des Raums, oder dort steht mehr als die Person: vor einem anderen Hintergrund aufnehmen
fail-walk-loose = Merkmale liegen { $rms } neben ihrem Platz (bis { $most } ist zu trauen), also ist den Kameras nicht zu trauen: Hat sich die Person bewegt, während die Kamera ging, oder zeigen die Fotos vor allem Wasser, Glas oder Menschen?
fail-walk-nothing = nichts in der Mitte der Kameras unterscheidet sich durch seine Farben vom Raum: Ist die Person in der Mitte der Fotos? Vor einem anderen Hintergrund aufnehmen
fail-walk-nowhere = es gibt keine Stelle, auf die fast alle Kameras schauen: die Person in der Mitte der Fotos halten
fail-walk-open = die Kameras lassen { $gap } um die Person offen: ganz herumgehen
fail-walk-still = die Kamera ging nicht herum: Von dem, was die Fotos gemeinsam haben, stehen { $still } Merkmale im Bild still und nur { $moved } bewegen sich; wenn sich die Person vor einer Kamera auf dem Stativ gedreht hat, oben das Häkchen bei der herumgegangenen Kamera entfernen
fail-walk-unsettled = die Umrisse kommen nicht zur Ruhe: Die der letzten beiden Durchgänge stimmen nur zu { $share } überein ({ $least } werden verlangt): vor einem anderen Hintergrund aufnehmen
fail-walk-views = nur { $found } Fotos haben eine Kamera, aber um eine Person durch Herumgehen vom Raum zu trennen, braucht es mindestens { $least }: mehr Fotos aufnehmen, ganz herum
files-heic = { $count ->
    [one] ein HEIC-Foto
   *[other] { $count } HEIC-Fotos
} ({ $files }{ $more })
files-other = { $count ->
    [one] ein Bild in einem anderen Format
   *[other] { $count } Bilder in anderen Formaten
} ({ $files }{ $more })
files-raw = { $count ->
    [one] ein Rohfoto
   *[other] { $count } Rohfotos
} ({ $files }{ $more })
files-video = { $count ->
    [one] ein Video
   *[other] { $count } Videos
} ({ $files }{ $more })
find-arms = was sich bewegt, reicht an beide Seiten: Es ist vielleicht abgeschnitten, oder dahinter gehen Personen
find-arms-mend = zurücktreten und den Hintergrund ruhig halten
find-black = auf einem Zehntel des Bildes oder mehr schwarz
find-blurred = unscharf neben den anderen
find-blurred-mend = noch einmal aufnehmen oder weglassen
find-burnt = auf einem Zehntel des Bildes oder mehr überbelichtet
find-can-bmi = ja, mit Verhältnissen und Body-Mass-Index
find-can-cm = in Zentimetern, aus: { $source }
find-can-features = aus dem, was sich mit der Person dreht: gemusterte Kleidung, ein gemustertes Tuch auf der Scheibe
find-can-mat = aus der Matte, Foto für Foto
find-can-no = nein
find-can-no-mat = mit dieser Matte nicht: siehe oben
find-can-not-turning = nein: auf diesen Fotos dreht sich niemand vor einer festen Kamera, oder eine Scheibe oder Matte ist da
find-can-ratios = ja, mit Verhältnissen; der Body-Mass-Index braucht Gewicht und Körpergröße
find-can-relative = relativ: Verhältnisse stimmen, keine Zentimeter
find-can-stopped = so nicht: siehe oben
find-can-turning = eine Person dreht sich vor einer festen Kamera: ohne Drehscheibe so messen, mit der Körpergröße
find-can-walked = nicht als Drehung
find-empty = die Person, die alle anderen Fotos zeigen, ist hier nicht zu sehen
find-empty-mend = weglassen oder noch einmal aufnehmen
find-empty-plate = zeigt es die leere Szene, dann als deren Foto angeben; sonst weglassen oder noch einmal aufnehmen
find-feet = der Körper ist am unteren Rand abgeschnitten
find-feet-mend = die ganze Person im Bild behalten, mit Platz unter den Füßen: Ohne Füße ist keine Höhe bekannt, und kein Umfang wird angegeben
find-few = { $count } Fotos sind wenige: Ohne Matte werden Merkmale über höchstens 30° verfolgt
find-few-mend = 18 bis 36 Fotos einer vollen Drehung aufnehmen oder eine Matte auf die Scheibe legen
find-focal = nichts verrät die Brennweite
find-focal-mend = EXIF in den Fotos lassen oder die Brennweite angeben
find-from-disk = Durchmesser der Scheibe, falls ihr Rand zu sehen ist
find-from-mat = Matte mit Marken
find-from-reference = bekannte Länge
find-from-reference-disk = bekannte Länge (Scheibe)
find-from-reference-points = bekannte Länge (zwei Punkte)
find-from-reference-stature = bekannte Länge (Körpergröße)
find-from-reference-tag = bekannte Länge (Größe einer Marke)
find-from-stature = Körpergröße
find-gap = das nächste Foto unterscheidet sich weit mehr als sonst
find-gap-mend = nachsehen, ob dort ein Foto fehlt
find-head = was sich bewegt, reicht an den oberen Rand: Oben ist vielleicht etwas abgeschnitten
find-head-mend = darüber Platz lassen
find-length = keine Länge ist bekannt: Längen werden relativ
find-length-mend = Körpergröße oder Drehscheibe angeben oder eine Matte auf die Scheibe legen
find-lost-mend = mit fester Belichtung noch einmal aufnehmen
find-mat = eine Matte ist angegeben, aber keine ihrer Marken wurde gefunden
find-mat-mend = ist sie im Bild, gut beleuchtet und flach?
find-mat-other-mend = die Datei der Matte angeben, die auf der Scheibe liegt, oder die Angaben der Matte berichtigen
find-moved = nur { $still } des Bildes stehen still: Die Kamera oder alles hinter der Person bewegte sich zwischen den Fotos
find-moved-mend = für eine Drehung gehört die Kamera auf ein Stativ und die Person auf eine Drehscheibe; wurde die Kamera um eine stehende Person herumgetragen? Dann das angeben
find-noise = die Fotos rauschen um { $levels } Graustufen
find-noise-mend = Umrissen können Teile fehlen, wo Kleidung die Farbe des Hintergrunds hat: bei mehr Licht, mit niedrigerem ISO-Wert oder in Kleidung aufnehmen, die sich mehr vom Hintergrund unterscheidet
find-pixels = Fotos von { $width } × { $height } Pixeln sind klein
find-pixels-mend = die Dateien übergeben, wie die Kamera sie schrieb
find-plate = es gibt kein Foto der leeren Szene
find-plate-mend = eines ohne die Person aufnehmen und plate.jpg nennen: Umrisse werden sicherer
find-same = zwischen diesen Fotos und dem nächsten drehte sich nichts
find-same-mend = von je zweien eines weglassen
find-shuffled = aufeinander folgende Fotos ähneln einander nicht mehr als beliebige zwei: Sie folgen nicht der Drehung
find-shuffled-mend = die Fotos in der Reihenfolge der Drehung benennen und noch einmal übergeben
find-tags = auf einem Foto lesbar: nur { $read } von { $all } Marken der Matte
find-tags-mend = sie sind im Bild zu klein, unscharf oder verdeckt: die Dateien übergeben, wie die Kamera sie schrieb, näher herangehen oder eine Matte mit weniger, größeren Marken drucken
find-uneven = von { $low } bis { $high } gegen die mittlere belichtet
find-uneven-mend = Belichtung und Weißabgleich festhalten (am Telefon: gedrückt halten, bis AE/AF-Sperre erscheint)
girth-name-AC = Oberarme
girth-name-AC-L = Oberarm links
girth-name-AC-R = Oberarm rechts
girth-name-AC-mean = Oberarm
girth-name-CC = Brust
girth-name-CFC = Waden
girth-name-CFC-L = Wade links
girth-name-CFC-R = Wade rechts
girth-name-HC = Hüfte
girth-name-HC-max = Hüfte, größter Umfang
girth-name-NC = Hals
girth-name-TC = Oberschenkel
girth-name-TC-L = Oberschenkel links
girth-name-TC-R = Oberschenkel rechts
girth-name-WC = Taille
girth-name-WC-hip-bone = Taille am Hüftknochen
girth-name-WC-narrowest = Taille, schmalste Stelle
girth-name-WC-natural = Taille, natürliche
girth-name-WC-navel = Taille am Nabel
girth-name-picked = durch gewählte Punkte
girth-name-stature = Körpergröße
length-disk = Durchmesser der Scheibe
length-mat = Matte mit Marken
length-reference = bekannte Länge
length-relative = { $length } des Kameraabstands
length-stature = Körpergröße
length-surface-unit = Einheit der Oberfläche
length-tags = Marken bekannter Größe
mask-empty = leer
mask-full = voll oder umgekehrt
mask-other-size = anders groß als das Foto
note-density = versuchsweise; mit der Luft in der Lunge; 1 % Fehler des Volumens ist 1 % Fehler der Dichte
note-nice = Taille zu Größe: NICE 2022 nennt 0,5 als Grenze, unter der man bleiben soll; keine Diagnose
note-open = kein Foto zeigt den Umriss entlang eines Teils dieses Schnitts (Hände davor oder zu wenige Fotos): bis zu { $share } des Maßbands sind vielleicht nicht Körper; mehr Fotos aufnehmen oder die Hände weiter weg halten
note-who = WHO 2008: erhöhtes Risiko ab 0,90 (Männer), 0,85 (Frauen); keine Diagnose
note-who-men = WHO 2008: erhöhtes Risiko ab 0,90 (Männer); keine Diagnose
note-who-women = WHO 2008: erhöhtes Risiko ab 0,85 (Frauen); keine Diagnose
number-in-metres = ; sind { $metres }m gemeint?
people-without-feet = der Körper ist am unteren Rand von { $names } abgeschnitten; die ganze Person im Bild behalten, mit Platz unter den Füßen: Ohne Füße ist keine Höhe bekannt, und kein Umfang wird angegeben
photos-and-more = { $names } und { $count } weitere
photos-below = ; Ordner in Ordnern werden nur auf der Kommandozeile gelesen
photos-near = ; es gibt { $files }
photos-none-fits = keine von { $count } Dateien passt ({ $files }{ $more })
photos-none-given = kein Foto wurde übergeben
photos-not-counted = {" "}(Kopien eines anderen Fotos zählen nicht: { $copies })
rig-among = die Marken { $first } bis { $last } von `rim` sind auch in `mat`: ihnen eigene `ids` geben
rig-day = ein Tag wie "2016-05-01"
rig-day-or-exif = ein Tag wie "2026-05-01" oder "exif" für den der Fotos
rig-ends = eine Liste von Fotos mit den beiden Enden in jedem, { $example },
rig-facts = muss eine Tabelle mit Schlüsseln von capture.toml sein, { $value } ist aber keine
rig-family = tag36h11, denn nur diese Familie ist bekannt,
rig-file-and-facts = capture.toml und was daneben angegeben ist: { $what }
rig-file = capture.toml: { $what }
rig-ids = [erste, letzte], die letzte höchstens 586,
rig-ids-of = [erste, letzte] von { $count } Nummern
rig-lacks = in `{ $table }` fehlt `{ $key }`
rig-near = ist `{ $near }` gemeint?{" "}
rig-no-radius = `rim` hat kein `radius_mm`, `disk` keinen Durchmesser
rig-number = eine Zahl von { $least } bis { $most }
rig-one-fact = `subject.born` und `subject.age_years` sind dasselbe: eines davon weglassen
rig-pixel = ein Pixel, [x, y],
rig-points-only = `reference.seen` oder --seen gibt die Enden einer Länge an und gehört nur zu `reference.kind` "points": --reference points=297mm angeben oder es weglassen
rig-rim-alone = `rim` hat Marken am Rand der Scheibe, aber `mat` fehlt: Diese Marken dienen nur neben einer Matte auf der Scheibe
rig-sexes = "female" oder "male" (wessen Wachstumskurven gemeint sind)
rig-table = eine Tabelle
rig-text = ein Text
rig-texts = ein Text oder eine Liste von Texten
rig-two-ends = zu `reference.kind` "points" müssen beide Enden in mindestens zwei Fotos angegeben sein: `reference.seen = { $example }`, oder --seen
rig-unknown = `{ $key }` gibt es nicht; { $near }bekannt sind { $known }
rig-wants = `{ $key }` muss { $wants } sein, ist aber { $got }
some-numbers = { $least }–{ $most }
some-photos = { $names }, … ({ $count } Fotos)
warn-agree-less = die Fotos stimmen auf der verfeinerten Oberfläche schlechter überein als vorher: Umrisse und Kameras ansehen, bevor Umfängen auf den Millimeter getraut wird
warn-amid = { $share } der Merkmale inmitten der Kameras sind in keinem Umriss: Fehlt etwas von der Person, oder steht etwas neben ihr? Die Umrisse ansehen
warn-and-more = und so weiter, { $count } weitere Fotos
warn-arm-unlike = ein Arm ist anders als die, an denen seine Gelenke bestimmt wurden, darum sind die Bereiche weiter: Ist er bloß, hängt er oder ist er zur Seite gestreckt, und stimmt die Körpergröße?
warn-border = die Person reicht über den Rand von { $names }: Was abgeschnitten ist, fehlt
warn-born-later = die Aufnahme liegt vor dem Tag der Geburt
warn-born-no-day = der Tag der Geburt ist angegeben, aber nicht der der Aufnahme, so dass das Alter nicht bekannt ist: das Alter angeben
warn-bottom = was unter der Person ist, gilt als Teil von ihr, bis hinab zu { $height }, wo die Fotos es abzuschneiden beginnen
warn-by-colour = { $why }; darum werden Fotos allein nach Farben zerlegt
warn-capture-toml = in den Angaben zur Aufnahme: { $what }
warn-contradicted = dem Umriss fehlt, was alle anderen Fotos als Körper zeigen ({ $share } von ihm): diesen Umriss ansehen und berichtigen
warn-crossing = { $count ->
    [one] ein Paar von Flächen durchdringt sich: die Oberfläche dort ansehen, bevor quer darüber ein Umfang gilt
   *[other] { $count } Paare von Flächen durchdringen sich: die Oberfläche dort ansehen, bevor quer darüber ein Umfang gilt
}
warn-cut-lower = der Körper ist am unteren Rand von { $names } abgeschnitten: den ganzen Menschen ins Bild nehmen, mit Abstand unter den Füßen
warn-cut-side = der Körper ist am linken oder rechten Rand von { $names } abgeschnitten: den ganzen Menschen ins Bild nehmen, mit Abstand neben den Armen
warn-cut-through = ein großer Teil der Oberfläche ist eine Ebene: Ist der Körper durchgeschnitten, so dass nur ein Teil von ihm da ist?
warn-cut-upper = der Körper ist am oberen Rand von { $names } abgeschnitten: den ganzen Menschen ins Bild nehmen, mit Abstand über dem Kopf
warn-degenerate = die Fotos bestimmen die Kameras nicht ganz, so dass ihrer Genauigkeit nicht zu trauen ist: eine Matte auf die Scheibe legen oder mehr Fotos aufnehmen
warn-density = Gewicht / Volumen = { $density }, Körper haben aber 0,93 bis 1,1: Wenn dies keine Puppe ist, stimmt Maßstab, Gewicht oder Oberfläche nicht (ist der Körper abgeschnitten?); die Umrisse ansehen
warn-disagree = { $other } und { $first } weichen um { $off } voneinander ab: { $first } gilt; beide Angaben prüfen
warn-disagree-cm = { $other } wurde mit { $given } angegeben, ist aber nach { $first } { $seen }: { $first } gilt; beide prüfen (eine Körpergröße ist ohne Schuhe)
warn-disputed = { $other } wurde mit { $given } angegeben, ist aber nach { $first } { $seen }, und keine von beiden kann sich so weit irren: Längen sind relativ, ohne Zentimeter; eine von beiden berichtigen, die unsicherere weglassen, oder ansehen, ob den Umrissen Beine oder Kopf fehlen
warn-disputed-layout = { $other } und { $first } widersprechen einander um { $off }, mehr als sich eine davon irren kann: Längen sind relativ, ohne Zentimeter; eine von beiden berichtigen oder die unsicherere weglassen
warn-empty-photo = ein Foto zeigt niemanden: es weglassen oder seinen Umriss berichtigen
warn-empty-photos = auf { $names } ist fast nichts von der Person zu sehen: solche Fotos weglassen oder ihre Umrisse berichtigen
warn-evolve = die Verfeinerung ließ die Fotos schlechter übereinstimmen; die Oberfläche bleibt, wie sie kam: Umrisse und Kameras ansehen
warn-feet-lost = die Oberfläche endet { $end } über dem Boden ohne Füße: Sie fehlen, und Höhen gelten ab dem Boden
warn-few-features = nur { $seen } Merkmale sind auch auf anderen Fotos zu sehen: eine Matte oder ein gemustertes Tuch auf die Scheibe legen oder in kleineren Schritten drehen
warn-few-fit = nur { $share } der Merkmale passen zu den Kameras: den Kamerakreis ansehen, bevor ihm getraut wird
warn-few-hold = nur { $count } Merkmale gemeinsam mit anderen Fotos, so dass die Kamera aus denen der anderen folgt: Ist das Foto an seinem Platz in der Drehung?
warn-few-tags = zeigt weniger als zwei Marken
warn-focal = die Brennweite ergab sich { $off } neben der, die angegeben ist oder in den Fotos steht: diese Angabe prüfen
warn-folds = die Haut ist { $share } länger als ein Maßband, was auf ein Loch in der Oberfläche oder einen anliegenden Arm weist: den Schnitt ansehen
warn-front = keine Füße sagen, wohin der Körper blickt, so dass Hüfte und Hals auf falscher Höhe sein können: Verdecken Schuhe oder ein langer Mantel sie?
warn-fused = Glied und Rumpf sind dort auf der Oberfläche eins: das Glied weiter weg halten
warn-ground-above = der Boden, den die Kameras angeben, liegt { $far } über den Sohlen der Oberfläche: Der Körper steht nicht darauf; Höhen und Körpergröße gelten ab den Sohlen
warn-ground-below = der Boden, den die Kameras angeben, liegt { $far } unter den Sohlen der Oberfläche: Der Körper steht nicht darauf; Höhen und Körpergröße gelten ab den Sohlen
warn-guessed-levels = dieser Körper{ $tall } liegt außerhalb dessen, was das Modell für Taille und Brust kennt: Wo Taille und Brust liegen, ist grob geschätzt, und ihre Bereiche sind entsprechend weit; die Körpergröße prüfen, und ob der ganze Körper zu sehen und aufrecht ist
warn-hand = eine Hand oder ein Unterarm ist dort auf der Oberfläche eins mit dem Körper: die Hände weiter weg halten
warn-hangs-apart = die Oberfläche fasst { $share } von dem, was alle Umrisse als Körper zeigen, der Rest hängt nicht daran und wurde weggelassen: ansehen, wo die Umrisse den Körper durchschneiden
warn-hip-hidden = wo das Gesäß am weitesten nach hinten reicht, ist nicht zu sehen; die Höhe der Hüfte ist aus dem übrigen Körper geschätzt, ihr Bereich ist weiter: Verdeckt sie ein Rock oder ein Mantel?
warn-hull-cut = die Hülle ist dort abgeschnitten, wo die Suche endete: Die Fotos sehen nicht um den Körper herum, oder Umrisse und Kameras gehören nicht zusammen
warn-hull-parts = kleinere Teile weggelassen: { $count }, zusammen { $left_out } des Volumens; fehlt etwas vom Körper, dann die Umrisse ansehen
warn-hull-pieces = die Hülle ist in Stücken: Nur das größte wurde behalten, { $left_out } des Volumens weggelassen; ansehen, wo die Umrisse den Körper durchschneiden
warn-incomplete = ein großer Teil des Körpers fehlt auf der Oberfläche: die Umrisse ansehen
warn-kept-body = Umrisse zeigen auf { $names } Körper, wo ein gelernter Blick auf Menschen keinen sieht: diese Umrisse ansehen
warn-large-step = zwischen { $before } und { $after } hat sich die Scheibe um { $turn } gedreht, nicht um { $usual }: Fehlt dort ein Foto?
warn-lengths = bekannte Längen widersprechen einander: eine davon berichtigen oder weglassen
warn-light = die Oberfläche fasst { $holds }, ein Körper von { $weight } füllt etwa { $fills }: { $missing } des Volumens fehlen; die Umrisse ansehen, Maßstab und Gewicht prüfen
warn-lost = { $name } (Foto { $number }) hat keine Kamera: { $why }
warn-lost-arm = Umrisse lassen einen Arm oder einen Teil davon auf { $names } weg, wo ein gelernter Blick auf Menschen ihn sieht: diese Umrisse ansehen
warn-lost-head = Umrisse lassen den Kopf oder einen Teil davon auf { $names } weg, wo ein gelernter Blick auf Menschen ihn sieht: diese Umrisse ansehen
warn-lost-leg = Umrisse lassen ein Bein oder einen Teil davon auf { $names } weg, wo ein gelernter Blick auf Menschen es sieht: diese Umrisse ansehen
warn-lost-trunk = Umrisse lassen einen Teil des Rumpfs auf { $names } weg, wo ein gelernter Blick auf Menschen ihn sieht: diese Umrisse ansehen
warn-made-levels = dieser Körper{ $tall } liegt außerhalb der Erwachsenen, an denen das Modell für Taille und Brust bestimmt wurde (ein Kind, eine kleine Figur, eine ungewöhnliche Statur oder eine falsche Körpergröße): Wo Taille und Brust liegen, kommt von künstlichen Körpern, und ihre Bereiche sind weiter
warn-many-legs = die Oberfläche hat mehr als zwei Beine: ein Stuhl, ein Tier oder zwei Menschen, die sich berühren? Gebraucht wird ein Mensch, der frei steht
warn-mat = eine Matte ist angegeben, wurde aber auf keinem Foto gefunden: Die Kameras folgen aus Merkmalen allein; liegt sie im Bild, in gutem Licht und flach?
warn-mat-about = die Matte wurde erkannt: { $count } Marken, Nummern { $first } bis { $last }, auf einem Ring mit { $radius } Radius, auf { $open } genau ({ $share } aller Längen); für genaue Längen eine Matte drucken, deren Datei vorliegt (Marken { $first } bis { $last })
warn-mat-known = die Matte wurde erkannt: { $count } Marken, Nummern { $first } bis { $last }, auf einem Ring mit { $radius } Radius
warn-mat-no-ring = die Marken auf den Fotos liegen nicht wie auf einer Matte von tailor: Sie werden nicht benutzt
warn-mat-other = die Marken auf den Fotos sind die einer anderen Matte als angegeben: { $count } im Kreis, Nummern { $first } bis { $last }, auf einem Ring von { $ring } Markenbreiten; angegeben sind { $given } ab Nummer { $from } auf { $wide }
warn-mat-odd = die Marken liegen auf einem Ring mit { $radius } Radius, wenn sie { $tag } mm breit sind, und so ist keine Matte von tailor: eine gedruckte Marke noch einmal messen; die Marken werden nicht benutzt
warn-misfit = die Merkmale sind { $off } neben ihrem Platz, { $usual } auf den meisten Fotos: Hat sich die Kamera oder die Person bewegt?
warn-mostly-lost = { $count } von { $of } Umrissen lassen einen Teil des Körpers weg, der dafür gebraucht wird: diese Umrisse berichtigen oder ein Foto der leeren Szene aufnehmen (plate.jpg)
warn-neck-groove = der Hals ist auf dieser Oberfläche zu kurz für ein Maßband: das Kinn heben
warn-neck-unlike = dieser Hals ist anders als die, an denen seine Höhe bestimmt wurde, so dass sein Bereich weiter ist: Ist der Kopf gerade und der Hals frei?
warn-no-arms = nirgends steht ein Arm frei vom Rumpf, so dass nichts sagt, ob Arme in diesem Schnitt sind: sie vom Körper weg halten
warn-no-camera = { $count ->
    [one] ein Foto hat in der Datei keine Kamera und ist weggelassen
   *[other] { $count } Fotos haben in der Datei keine Kamera und sind weggelassen
}
warn-no-circle = die Kameras stehen auf keinem Kreis: Die Lage aus der Datei gilt; sind sie von einer Drehung, dann die Datei prüfen
warn-no-day = die Fotos haben kein Datum, so dass der Tag der Aufnahme nicht bekannt ist: ihn angeben
warn-no-edge = weder der Rand der Scheibe noch Sohlen waren zu sehen: Der Boden liegt beim tiefsten Merkmal, so dass Höhen und Körpergröße falsch sein können; Füße und Scheibe im Bild behalten
warn-no-extreme = dieser Körper ist zwischen den Marken dieser Definition nirgends am schmalsten oder am stärksten: eine andere wählen
warn-no-face = weggelassen, denn wo das Gesicht ist, ist nicht bekannt
warn-no-focal = die Brennweite ist unbekannt und folgt kaum aus den Fotos: sie angeben
warn-no-ground = keine Füße enden am Boden, so dass nichts die Höhen sagt: Ist der Körper abgeschnitten, verdecken Hosen oder ein Mantel die Füße, oder ist der Boden der Kameras falsch?
warn-no-head = oben ist die Oberfläche flach und kein Scheitel: Der Kopf fehlt oder ist vom Rand der Fotos abgeschnitten
warn-no-interval = kein Bereich ist angegeben, denn ein Teil, auf den es ankommt, ist nicht bekannt (welcher, steht im Bericht)
warn-no-legs = die Oberfläche zeigt keine zwei Beine: Ist der Körper abgeschnitten, oder fehlt den Umrissen ein Bein? Mit den Füßen auseinander stehen, ohne Mantel oder Rock
warn-no-limb = dieses Glied ließ sich nicht bis zum Rumpf verfolgen: es vom Körper weg halten
warn-no-mask = { $name } hat keinen Umriss und wurde weggelassen: seinen Umriss unter dem Namen des Fotos neben die anderen legen
warn-no-neck = zwischen Kopf und Schultern wurde kein Hals gefunden: Verdecken ihn Haare oder ein Kragen, oder schneiden die Fotos den Kopf ab?
warn-no-neck-head = zwischen Kopf und Schultern wurde kein Hals gefunden, so dass nicht bekannt ist, ob der Kopf da ist
warn-no-peak = zwischen den Gelenken ist nirgends die dickste Stelle: Verdeckt sie ein Saum, ein Stiefel oder ein Verband?
warn-no-plate = es gibt kein Foto der leeren Szene: Sie wird aus dem erraten, was still steht, und das kann Teile des Körpers kosten; die Umrisse ansehen oder ein Foto ohne die Person aufnehmen und plate.jpg nennen
warn-no-section = die Oberfläche hat dort keinen geschlossenen Schnitt
warn-no-step = zwischen { $before } und { $after } hat sich die Scheibe nicht gedreht: eines davon weglassen
warn-no-unit = die Datei sagt nichts über ihre Einheit: Längen sind relativ
warn-nobody = auf { $names } ist niemand zu sehen, obwohl die anderen Fotos einen Menschen zeigen: ist es die leere Szene, oder verdeckt etwas den Menschen? Noch einmal aufnehmen oder weglassen
warn-not-measured = { $girths } nicht gemessen: { $why }
warn-not-read = { $files }: nicht gelesen; gehören sie zur Drehung, dann umwandeln: { $way }
warn-not-turned = zwischen { $before } und { $after } hat sich die Scheibe nicht gedreht: eines davon weglassen
warn-not-upright = Rumpf und Beine sind nicht die eines aufrechten Körpers: Liegt, sitzt oder bückt er sich, oder steht er auf dem Kopf?
warn-nothing = nichts wurde gemessen: { $why }
warn-nudged = die Kamera schaut { $off } an dem vorbei, wohin die anderen Kameras schauen: Wurde die Kamera bewegt?
warn-off-circle = die Kamera steht { $off } neben dem Kreis der anderen: Wurden Kamera oder Scheibe bewegt?
warn-on-side = der Mensch liegt auf { $names } auf der Seite: solche Fotos drehen oder aufrecht stehen
warn-only-video = das Video wird gelesen, nicht was daneben ist: { $count } Fotos ({ $first }, …)
warn-open = kein Foto zeigt den Umriss entlang eines Teils dieses Schnitts (Hände davor oder zu wenige Fotos): bis zu { $length } sind vielleicht nicht Körper; mehr Fotos aufnehmen oder die Hände weiter weg halten
warn-order = { $early } wurde vor { $late } aufgenommen: Die Namen sollen der Drehung folgen
warn-other-camera = { $name } kommt von einer anderen Kamera ({ $camera }) als die meisten Fotos ({ $usual }): Eine Kamera muss die ganze Drehung aufnehmen; neu aufnehmen oder weglassen
warn-other-step = zwischen { $before } und { $after } hat sich die Scheibe um { $turn } gedreht, sonst meist um { $usual }: Fehlt dort ein Foto, oder ist eines nicht an seinem Platz?
warn-out-of-range = der Körper liegt außerhalb derer, an denen die Höhen bestimmt wurden, so dass die Höhe nicht gut genug bekannt ist
warn-outline-cuts = der Umriss auf { $names } schneidet bis zu { $share } von dem weg, was fast alle anderen Fotos als Körper zeigen: diesen Umriss ansehen; ihn berichtigen oder das Foto weglassen
warn-outlines = die Umrisse einiger Fotos widersprechen denen aller anderen: diese Umrisse ansehen
warn-page-weight = der Bericht hat { $size }, mehr als { $most }
warn-patch = ein Fleck in einer Farbe, die der Körper sonst nirgends hat, zählt als Körper, wo kein Foto den leeren Raum zeigt: Ist es ein Stück Wand neben Arm oder Rumpf? Umfänge dort können zu groß sein; diese Umrisse ansehen
warn-points-few = die beiden Punkte der bekannten Strecke sind in { $count } Fotos mit Kamera zu sehen, zu sehr von derselben Seite: in Fotos zeigen, die einige Schritte auseinander liegen; die Strecke blieb unbeachtet
warn-points-miss = die beiden Punkte der bekannten Strecke verfehlen einander von Foto zu Foto um { $off }: sind es in jedem dieselben zwei, in derselben Reihenfolge, und bewegen sie sich mit dem Menschen? Die Strecke blieb unbeachtet
warn-points-photo = die beiden Punkte der bekannten Strecke sind für { $name } angegeben, aber so heißt kein Foto der Aufnahme, oder es hat keine Kamera bekommen; die Strecke blieb unbeachtet
warn-points-unsure = die Strecke zwischen den beiden Punkten ist nur auf { $sigma } sicher: zwei nehmen, die weiter auseinander liegen, in mehr Fotos; die Strecke blieb unbeachtet
warn-reference = eine bekannte Länge der Art { $kind } gibt es hier nicht
warn-relative = nichts sagt etwas über Millimeter (keine Matte, keine Marken bekannter Größe, keine Strecke, keine Scheibe, keine Körpergröße, die zu sehen wäre): Längen sind relativ zum Radius der Kameras; eines davon angeben
warn-rim-few = Marken am Rand der Scheibe sind angegeben, aber nur { $count } Beobachtungen taugen: Angaben, Licht am Rand und Bildausschnitt prüfen
warn-rim-off = die Marken am Rand liegen { $rim } neben ihrem Platz, die auf der Scheibe { $mat }: Sie wurden weggelassen; eine gedruckte Marke und die Scheibe messen
warn-room-moved = zwischen { $before } und { $after } verschob sich der Raum im Foto um { $by }: Die Kamera wurde bewegt; weglassen, was davor oder danach aufgenommen wurde, oder die Drehung neu aufnehmen
warn-same-colours = Person und Raum haben dort fast dieselben Farben; die Umrisse ansehen
warn-same-file = { $copy } ist dieselbe Datei wie { $first } und wurde weggelassen: Gehört ein anderes Foto an diese Stelle, dann dieses übergeben
warn-same-raw = { $copy } ist dieselbe Datei wie { $first } und wurde weggelassen
warn-scan = { $name } gilt als { $unit } mit { $axis } nach oben, { $height } groß: Stimmt das?
warn-scan-holes = { $name }: Löcher, flach geschlossen: { $count }, bis zu { $across } weit; Maße über ein großes hinweg werden zu kurz
warn-scan-inward = { $name }: Die Flächen zeigen nach innen; sie wurden umgedreht
warn-scan-mixed = { $name }: Flächen, die anders als ihre Nachbarn nach innen zeigten, wurden umgedreht: { $count }
warn-scan-pieces = { $name }: Teile, die nicht mit dem Körper zusammenhängen, sind weggelassen: { $count }
warn-seen-by-two = nur { $share } der Oberfläche sind auf zwei Fotos oder mehr zu sehen: mehr Fotos der Drehung aufnehmen oder die Umrisse ansehen
warn-several = auf { $names } ist mehr als ein Mensch zu sehen: gemessen wird nur, wer sich dreht; solche Fotos ohne andere Menschen, Spiegel oder Bilder von Menschen noch einmal aufnehmen
warn-shares-little = hat zu wenig mit den anderen gemein
warn-short = die Oberfläche ist { $height } hoch, die Körpergröße wurde mit { $stature } angegeben: { $missing } der Höhe fehlen; ansehen, ob die Umrisse Beine und Kopf haben
warn-shortened = Maßbänder und ihre Bereiche sind um { $by } % kürzer, wie angegeben
warn-shows-same = { $after } zeigt dasselbe wie { $before }, dazwischen drehte sich nichts: eines davon weglassen
warn-sideways = die Fotos liegen auf der Seite; wo oben ist, wurde geraten: die Fotos aufrecht drehen, um sicher zu sein
warn-spline-left = die glatte Kurve durch Punkte der Oberfläche (Spline) liegt { $off } neben dem genauen Schnitt: Die Oberfläche ist dort zu grob; Maßband oder Kontur nehmen
warn-covered = der Schnitt geht über ein Loch des Scans, das flach geschlossen ist: Der Bereich ist um das weiter, was die Haut sich dort wölben kann
warn-colors-alike = was getragen wird und was dahinter ist, sehen sich dort am Umriss ähnlich, auf { $names }: Die Bereiche sind um das weiter, was Masken weglassen oder behalten können; eine andere Farbe tragen
warn-split = die Arme berühren den Rumpf und wurden geschätzt abgetrennt: Die Bereiche sind weiter; die Arme weiter vom Körper weg halten
warn-surface-fault = { $name }: { $fault }; Querschnitte dort fehlen vielleicht
warn-swayed = die Person bewegte sich gegen die Scheibe: Objektiv und Schritte blieben nahezu, wie sie angegeben sind, und wie sicher die Kameras sind, ist nicht bekannt
warn-tags-mat = sie liegen wie auf einer Matte von tailor ({ $count } Marken auf einem Ring vom { $ring }-fachen einer Marke): die Kante des schwarzen Quadrats einer gedruckten Marke messen, etwa 60 mm, und als „Marke der Matte“ angeben
warn-tags-strange = sie liegen nicht wie auf einer Matte von tailor: sie abdecken
warn-tags-unused = Marken (Familie 36h11, Nummern { $first } bis { $last }) sind auf { $seen } von { $photos } abgesuchten Fotos zu sehen, aber nichts ist über sie angegeben, darum werden sie nicht benutzt; { $layout }
warn-tall = {" "}({ $height } groß)
warn-thighs-low = die Beine treffen sich auf der Oberfläche { $far } unter dem Schritt, den Körpergröße und Hüfte erwarten lassen; die Oberschenkel sind deshalb tiefer gemessen, als sie am dicksten sein können, und ihre Intervalle reichen nach oben: mit den Füßen weiter auseinander stehen
warn-thighs-split = die Oberschenkel berühren sich und wurden zwischen den Falten vorn und hinten geschätzt getrennt: Die Bereiche sind weiter; die Füße weiter auseinander stellen
warn-thighs-one = die Oberschenkel sind auf der Oberfläche bis weit unter den Schritt eins, so dass ihre dickste Stelle nicht zu sehen ist: mit den Füßen weiter auseinander stehen
warn-too-many = { $count } Fotos sind mehr, als nützen: Das schärfste aus jedem von { $most } gleichen Abschnitten wird genommen; die Schritte dazwischen sind nicht mehr gleich
warn-too-uncertain = das Intervall wäre zu weit, um etwas zu nützen, darum steht hier keine Zahl: mehr und größere Fotos, enge Kleidung, Arme weg vom Körper und ein Foto der leeren Szene machen es enger
warn-turning-back = der Körper hat sich unterwegs um { $by } zurückgedreht: Die Fotos wurden genommen, wie sie sind
warn-turning-focal = nichts sagt die Brennweite: { $focal } wie bei der Hauptkamera von Telefonen wurde angenommen; sie angeben, wenn sie bekannt ist
warn-turning-odd = der Umriss auf { $names } passt nirgends in die Drehung und wurde weggelassen: Ist noch jemand im Bild, oder ist der Umriss falsch?
warn-turning-twice = der Körper hat sich { $count }-mal gedreht: Alle Fotos wurden zusammen genommen; eine Drehung genügt
warn-two-tags = für die Marken der Matte sind { $mat } mm und { $reference } mm angegeben: Das erste gilt; eine gedruckte Marke messen und die andere Angabe berichtigen
warn-two-turns = zwischen { $last } und { $first } vergingen { $pause }, sonst { $usual }: Sind das zwei Drehungen? Jede als eigene Aufnahme übergeben
warn-uneven-turn = die Scheibe hat sich ungleichmäßig gedreht, bald so, bald so herum: Die Fotos sollen der Drehung folgen
warn-unlike = der Umriss ist nicht, was die anderen Fotos zeigen; die Umrisse ansehen
warn-upside-down = der Mensch steht auf { $names } auf dem Kopf: solche Fotos drehen oder aufrecht stehen
warn-video-blurred = kein scharfes Bild bei { $times } s: gleichmäßig und bei mehr Licht drehen
warn-video-cut = { $name }: nur { $read } von { $promised } Bildern sind lesbar: Wurde es ganz kopiert?
warn-video-cut-for = { $name }: nur { $read } von { $promised } Bildern sind lesbar ({ $why }): Wurde es ganz kopiert?
warn-video-damaged = { $name } ist irgendwo beschädigt: { $why }
warn-video-fast = { $empty } von { $steps } Schritten der Drehung haben kein eigenes Bild: langsamer drehen
warn-video-open = von { $from } bis { $to } dreht sich etwas, sieht am Ende aber nicht aus wie am Anfang: Ist das eine ganze Drehung? Alles wurde genommen; von vor der Drehung bis danach filmen
warn-video-plate = { $name } hat { $size } Pixel, anders als die Drehung, und wurde weggelassen: die leere Szene so filmen wie die Drehung und plate.mp4 nennen
warn-video-steps = die Bilder eines Videos haben keine gleichen Schritte, darum wurden die angegebenen Schritte nicht benutzt
warn-video-still = kaum etwas bewegt sich: Steht die Person auf einer Scheibe, die sich dreht, und ist sie im Bild?
warn-walk-lost = { $name } (Foto { $number }) hat zu wenig mit den anderen gemein und keine Kamera
warn-wide-mat = die Marken der Matte reichen { $reach } von der Mitte der Scheibe, die Scheibe endet aber bei { $disk }: eine gedruckte Marke, den Ring und die Scheibe messen und berichtigen, was falsch ist
warn-wide-rim = der Streifen am Rand hat einen Radius von { $rim }, die Scheibe einen von { $disk }: die Scheibe messen und berichtigen, was falsch ist
warn-withheld = { $one } und { $other } widersprechen einander, darum fehlt, was davon abhängt: eine Angabe berichtigen oder weglassen
warn-worn = was getragen wird, steht am Saum von den Beinen ab, darum können bis zu { $share } dieses Umfangs Kleidung sein: enge kurze Hosen tragen
warn-worn-hides = was getragen wird, steht am Saum, { $height } über dem Boden, um { $off } von den Beinen ab, darum ist der Körper darunter nicht bekannt: enge kurze Hosen tragen
warn-wrong-place = { $after } kommt in der Drehung vor { $before }, nicht danach: die Fotos in die Reihenfolge der Drehung bringen
warn-zoomed = { $name } wurde mit { $focal } aufgenommen, die meisten mit { $usual }: während einer Drehung nicht zoomen; neu aufnehmen oder weglassen

# Mistakes of `--set`, `tailor compare`, `tailor score`
compare-against = gegen
compare-all = alle
compare-bias = Bias [mm]
compare-changed = verändert
compare-changed-not = nein
compare-changed-yes = JA
compare-cost = Zeit und Größe
compare-differs = { $side } weicht ab `{ $node }` von { $first } ab ({ $count } von { $all } Ergebnissen).
compare-farthest = am weitesten [mm]
compare-girth = Umfang
compare-girths = Umfänge mit dem Maßband
compare-intervals = nach Intervallen [mm]
compare-laid = { $side }, auf { $first } ausgerichtet (um { $turned } gedreht, um { $moved } verschoben)
compare-legend = Differenz: das Maßband weniger dem der ersten Seite. Nach Intervallen: die wahre Differenz ist neun von zehn Malen darin. LSC: kleinste Veränderung, die zählt; zwei Messungen desselben Körpers übertreffen sie einmal von zwanzig Malen; verändert: ob die Differenz größer ist.
compare-lsc = LSC [mm]
compare-mean = Mittel [mm]
compare-met-again = Andere Werte, dieselben Ergebnisse: { $nodes }.
compare-mixed = Längen von { $relative } sind relativ, denn es war keine bekannte Länge angegeben, die von { $metric } sind Zentimeter: Das lässt sich nicht vergleichen
compare-node = Knoten
compare-off = Differenz [mm]
compare-only = Nur { $side } hat { $nodes }.
compare-other = andere Seite
compare-95 = 95 % innerhalb [mm]
compare-relative = relativ
compare-rms = RMS [mm]
compare-same = { $side } hat in jedem Knoten dieselben Bytes wie { $first }.
compare-same-shared = { $side } hat in jedem Knoten, den beide haben, dieselben Bytes wie { $first }.
compare-settings = Werte, die verschieden sind
compare-surface = Oberfläche
compare-surfaces = Oberflächen: Abstände von der ersten
compare-to = { $low } bis { $high }
compare-volume = Volumen [l]
compare-what = was
compare-within = innerhalb der Grenze
compare-within-not = NEIN, { $mm } mm
compare-within-yes = ja, { $mm } mm
recipe-unknown = { $what ->
    [node] einen Knoten
    [variant] eine Variante
    [stage] eine Stufe
   *[other] „{ $what }“
    } `{ $name }` gibt es nicht; bekannt: { $known }
recipe-unknown-near = { $what ->
    [node] einen Knoten
    [variant] eine Variante
    [stage] eine Stufe
   *[other] „{ $what }“
    } `{ $name }` gibt es nicht; ist `{ $near }` gemeint? bekannt: { $known }
recipe-unknown-none = { $what ->
    [node] einen Knoten
    [variant] eine Variante
    [stage] eine Stufe
   *[other] „{ $what }“
    } `{ $name }` gibt es nicht; es gibt keine
recipe-choice = { $value } ist keines von { $words }
recipe-missing = fehlt: { $name } ist { $wanted }
recipe-range = { $value } ist außerhalb: von { $least } bis { $most }
recipe-type = muss { $wanted } sein, { $value } ist aber { $got }
recipe-a-boolean = ein Wahrheitswert
recipe-a-list = eine Liste
recipe-a-number = eine Zahl
recipe-a-section = ein Abschnitt aus benannten Tabellen
recipe-a-table = eine Tabelle
recipe-a-text = ein Text
recipe-a-whole = eine ganze Zahl
recipe-a-within = { $kind } von { $least } bis { $most }
recipe-a-one-of = eines von { $words }
recipe-entry = `{ $section }.{ $entry }`: { $what }
recipe-of-stage = { $stage }: { $what }
recipe-param = `{ $name }`: { $what }
recipe-set = `--set { $set }`: { $what }
recipe-set-form = KNOTEN.PARAM=WERT angeben, wie hull.voxel_mm=2
score-all = alles
score-at-plane = Maßband an der Ebene      dort wahr cm   Band cm  Fläche %  Fläche mm
score-cameras = Kameras   { $found } von { $of }; Maßstab { $scale } %; Zentren im Median { $median } mm, höchstens { $worst } mm; Drehung { $rotation } °; Brennweite { $focal } %
score-count = { $count } von { $all }
score-fail = ZU WEIT (±{ $mm } mm)
score-fail-all = ZU WEIT: { $within } von { $all } in { $mm } mm
score-girths = Umfang      wahr cm      cm  Fehler %   Band %  Band mm = Fläche + Höhe     ISO 20685-1
score-iso = Maßband   Fehler %        Fehler mm       ISO 20685-1           Wahrheit im Intervall
score-masks = Masken    { $count } verglichen; Schnitt durch Vereinigung im Mittel { $mean }, mindestens { $worst }
score-nothing = nichts zu vergleichen: weder Kameras noch Masken, eine Oberfläche oder Umfänge sind auf beiden Seiten
score-no-scale = ihre Längen sind relativ, denn es war keine bekannte Länge angegeben, oder bekannte Längen widersprechen sich: Mit Zentimetern lassen sie sich nicht vergleichen; beim Messen eine angeben, etwa --stature, und das bewerten
score-no-section = die wahre Oberfläche hat dort keinen solchen Schnitt: Glied und Rumpf sind eins, oder die Ebene geht vorbei
score-no-views = ihr fehlt die Liste `views`
score-not-measured = nicht gemessen
score-not-numbers = `{ $key }` von { $name } sind keine { $count } Zahlen
score-open = Fläche    { $faces } Dreiecke, NICHT geschlossen
score-outside = außerhalb seines Intervalls
score-paper = relativer Fehler % hier            Paper, Tabelle I Paper, Tabelle II
score-part = im Mittel { $mean } mm, 90 % innerhalb { $within } mm, Bias { $bias } mm; vollständig { $at_2 } % bei 2 mm, { $at_5 } % bei 5 mm
score-pass = erfüllt (±{ $mm } mm)
score-pass-all = erfüllt: { $within } von { $all } in { $mm } mm
score-surface = Fläche    { $faces } Dreiecke, geschlossen
score-trunk = Rumpf
fail-score-file = { $path }: { $why }
fail-side-file = { $path }: { $why }
cli-side-folder = { $path } fehlt: einen Ordner angeben, den `tailor measure` geschrieben hat
fail-side-gone = ein Ergebnis von { $name } ({ $what }) ist nicht mehr im Zwischenspeicher: noch einmal laufen lassen
fail-side-record = { $name } ist kein Protokoll eines Laufs
cli-compare-file = { $file }: { $why }
cli-compare-folder = `{ $folder }` ist kein Ordner; um Varianten zu vergleichen, zuerst ihre Pipeline nennen: tailor compare body as-is quick --input photos=ORDNER
cli-compare-gone = `{ $run }`: Das Protokoll dieses Laufs fehlt
cli-compare-pipeline = --replicate lässt Varianten laufen: zuerst ihre Pipeline nennen: tailor compare paper-synth rigid_once median_once --replicate 8
cli-compare-point = diese Reihen haben keinen Punkt gemeinsam: Verglichen werden dieselben Parameter und Wiederholungen, Stück für Stück
cli-compare-repeat = { $file }: { $why }
cli-compare-run = `{ $run }`: Der Zwischenspeicher kennt { $count ->
    [one] einen Lauf
   *[other] { $count } Läufe
    }
cli-compare-sweep = das ist kein sweep.json von `sweep --out`
cli-compare-two = zwei oder mehr angeben: Ordner, die `tailor measure` geschrieben hat, `last` und `last~1`, oder eine Pipeline (ihre Datei, oder den Namen einer eingebauten) und Varianten davon
cli-compare-variants = ihre Punkte sind von mehreren Varianten, die ihre eigene Seite vergleicht; Ordner von je einer angeben
cli-given = `{ $flag }`: { $what }
cli-score-beyond = { $name } ist um { $error } % daneben, nicht innerhalb { $most } %
cli-score-beyond-surface = { $name } ist an der gemessenen Ebene um { $error } % daneben, nicht innerhalb { $most } %
cli-score-percent = `{ $flag } { $wanted }`: NAME=PROZENT angeben, wie WC=1
cli-score-unmeasured = { $name } wurde nicht gemessen, oder die Wahrheit ist nicht bekannt
