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
result-missing = { $count ->
    [one] Ein Umfang ließ sich nicht messen
   *[other] { $count } Umfänge ließen sich nicht messen
}
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
wrong-heic = Das ist ein HEIC-Foto, das dieses Programm nicht liest. Auf dem Telefon „Maximale Kompatibilität“ wählen (iPhone: Einstellungen, Kamera, Formate) und die Fotos als JPEG aufnehmen oder senden, oder sie umwandeln: heif-convert EIN.heic AUS.jpg
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

# Wovor die Stufen warnen und warum Umfänge fehlen (warnings.rs)
warn-video-steps = Einzelbilder eines Videos liegen nicht in gleichen Schritten: Die Angabe der Schritte wurde übergangen
warn-same-file = { $a } ist dieselbe Datei wie { $b } und wurde weggelassen: Gehört ein anderes Foto an diese Stelle, dann dieses übergeben
warn-same-raw = { $a } ist dieselbe Datei wie { $b } und wurde weggelassen
warn-video-plate = { $a } hat { $b }×{ $c } Pixel, anders als die Drehung, und wurde weggelassen: die leere Szene so filmen wie die Drehung und plate.mp4 nennen
warn-too-many = { $a } Fotos sind mehr, als nützen: Das schärfste aus jedem von { $b } gleichen Abschnitten wird genommen; die Schritte dazwischen sind nicht mehr gleich
warn-surface-fault = { $a }; Querschnitte dort fehlen vielleicht
warn-video-open = von { $a } bis { $b } s dreht sich etwas, sieht am Ende aber nicht aus wie am Anfang: Ist das eine ganze Drehung? Alles wurde genommen; von vor der Drehung bis danach filmen
warn-video-fast = { $a } von { $b } Schritten der Drehung haben kein eigenes Bild: langsamer drehen
warn-video-blurred = kein scharfes Bild bei { $a } s: gleichmäßig und bei mehr Licht drehen
warn-video-still = kaum etwas bewegt sich: Steht die Person auf einer Scheibe, die sich dreht, und ist sie im Bild?
warn-two-turns = zwischen { $a } und { $b } vergingen { $c } s, sonst { $d } s: Sind das zwei Drehungen? Jede als eigene Aufnahme übergeben
warn-order = { $a } wurde vor { $b } aufgenommen: Die Namen sollen der Drehung folgen
warn-other-camera = { $a } kommt von einer anderen Kamera ({ $b }) als die meisten Fotos ({ $c }): Eine Kamera muss die ganze Drehung aufnehmen; neu aufnehmen oder weglassen
warn-zoomed = { $a } wurde mit { $b } mm aufgenommen, die meisten mit { $c } mm: während einer Drehung nicht zoomen; neu aufnehmen oder weglassen
warn-hull-cut = die Hülle ist dort abgeschnitten, wo die Suche endete: Die Fotos sehen nicht um den Körper herum, oder Umrisse und Kameras gehören nicht zusammen
warn-hull-parts = { $a } kleinere Teile, zusammen { $b } % des Volumens, wurden weggelassen: Fehlt etwas vom Körper, dann die Umrisse ansehen
warn-evolve = die Verfeinerung ließ die Fotos schlechter übereinstimmen; die Oberfläche bleibt, wie sie kam: Umrisse und Kameras ansehen
warn-seen-by-two = nur { $a } % der Oberfläche sind auf zwei Fotos oder mehr zu sehen: mehr Fotos der Drehung aufnehmen oder die Umrisse ansehen
warn-agree-less = die Fotos stimmen auf der verfeinerten Oberfläche schlechter überein als vorher: Umrisse und Kameras ansehen, bevor Umfängen auf den Millimeter getraut wird
warn-crossing = { $a } Paare von Flächen durchdringen sich: die Oberfläche dort ansehen, bevor quer darüber ein Umfang gilt
warn-open = ein Stück weit zeigt dort kein Foto den Umriss des Körpers, denn Hände sind davor oder es sind wenige Fotos, und die Oberfläche läuft in eine Ecke aus: etwa { $a } sind vielleicht nicht Körper; mehr Fotos aufnehmen oder die Hände weiter weg halten
warn-split = Arm und Rumpf sind dort auf der Oberfläche eins und wurden getrennt: Die Bereiche sind weiter; die Arme weiter weg halten
warn-no-interval = kein Bereich ist angegeben, denn ein Teil, auf den es ankommt, ist nicht bekannt (welcher, steht im Bericht)
warn-shortened = Maßbänder und ihre Bereiche sind um { $a } % kürzer, wie angegeben
warn-nothing = nichts wurde gemessen: { $a }
warn-front = keine Füße sagen, wohin der Körper blickt, so dass Hüfte und Hals auf falscher Höhe sein können: Verdecken Schuhe oder ein langer Mantel sie?
warn-made-levels = dieser Körper liegt außerhalb der Erwachsenen, an denen die Höhen bestimmt wurden (ein Kind, eine kleine Figur, ein ungewöhnlicher Bau oder eine falsche Körpergröße): Die Höhen von Taille und Brust kommen von gemachten Körpern, und die Bereiche sind weiter
warn-guessed-levels = dieser Körper gleicht keinem, an dem die Höhen bestimmt wurden: Die Höhen von Taille und Brust sind geraten, mit entsprechend weiten Bereichen; stimmt die Körpergröße, und ist der Körper ganz und aufrecht?
warn-ground-below = der Boden, den die Kameras angeben, liegt { $a } unter den Sohlen der Oberfläche: Der Körper steht nicht darauf; Höhen und Körpergröße gelten ab den Sohlen
warn-ground-above = der Boden, den die Kameras angeben, liegt { $a } über den Sohlen der Oberfläche: Der Körper steht nicht darauf; Höhen und Körpergröße gelten ab den Sohlen
warn-feet-lost = die Oberfläche endet { $a } über dem Boden ohne Füße: Sie fehlen, und Höhen gelten ab dem Boden
warn-density = Gewicht und Volumen ergeben { $a } kg/l, ein lebender Körper hat 0,93 bis 1,1: Ist es einer, dann stimmt Maßstab, Gewicht oder Oberfläche nicht (ist der Körper abgeschnitten?); die Umrisse ansehen
warn-spline-left = die glatte Kurve durch Punkte der Oberfläche (Spline) liegt { $a } % neben dem genauen Schnitt: Die Oberfläche ist dort zu grob; Maßband oder Kontur nehmen
warn-folds = die Haut ist { $a } % länger als ein Maßband, was auf ein Loch in der Oberfläche oder einen anliegenden Arm weist: den Schnitt ansehen
warn-mat = eine Matte ist angegeben, wurde aber auf keinem Foto gefunden: Die Kameras folgen aus Merkmalen allein; liegt sie im Bild, in gutem Licht und flach?
warn-walk-lost = { $a } (Foto { $b }) hat zu wenig mit den anderen gemein und keine Kamera
warn-lost = { $a } (Foto { $b }) hat keine Kamera: { $c }
warn-few-tags = zeigt weniger als zwei Marken
warn-shares-little = hat zu wenig mit den anderen gemein
warn-focal = die Brennweite ergab sich { $a } % neben der, die angegeben ist oder in den Fotos steht: diese Angabe prüfen
warn-off-circle = die Kamera steht { $a } % neben dem Kreis der anderen: Wurden Kamera oder Scheibe bewegt?
warn-degenerate = die Fotos bestimmen die Kameras nicht ganz, so dass ihrer Genauigkeit nicht zu trauen ist: eine Matte auf die Scheibe legen oder mehr Fotos aufnehmen
warn-few-features = nur { $a } Merkmale sind auch auf anderen Fotos zu sehen: eine Matte oder ein gemustertes Tuch auf die Scheibe legen oder in kleineren Schritten drehen
warn-relative = nichts sagt etwas über Millimeter (keine Matte, keine Strecke, keine Scheibe, keine Körpergröße, die zu sehen wäre): Längen sind relativ zum Radius der Kameras; eines davon angeben
warn-no-edge = weder der Rand der Scheibe noch Sohlen waren zu sehen: Der Boden liegt beim tiefsten Merkmal, so dass Höhen und Körpergröße falsch sein können; Füße und Scheibe im Bild behalten
warn-two-tags = für die Marken der Matte sind { $a } mm und { $b } mm angegeben: Das erste gilt; eine gedruckte Marke messen und die andere Angabe berichtigen
warn-reference = die Strecke `{ $a }` ist hier nicht bekannt: `subject_height`, `disk_diameter` und `tag_size` sind es
warn-disagree = { $a } und { $b } weichen um { $c } % voneinander ab: { $d } gilt; beide Angaben prüfen
warn-no-camera = { $a } Fotos haben in der Datei keine Kamera und wurden weggelassen
warn-no-circle = die Kameras stehen auf keinem Kreis: Die Lage aus der Datei gilt; sind sie von einer Drehung, dann die Datei prüfen
warn-no-unit = die Datei sagt nichts über ihre Einheit: Längen sind relativ
warn-few-hold = { $a } hält sich an nur { $b } Merkmale: Die Kamera folgt aus denen der anderen; ist das Foto an seinem Platz in der Drehung?
warn-few-fit = nur { $a } % der Merkmale passen zu den Kameras: den Kamerakreis ansehen, bevor ihm getraut wird
warn-no-focal = die Brennweite ist unbekannt und folgt kaum aus den Fotos: sie angeben
warn-swayed = die Person bewegte sich gegen die Scheibe: Objektiv und Schritte blieben, wie sie angegeben sind, und wie sicher die Kameras sind, ist nicht bekannt
warn-sideways = die Fotos liegen auf der Seite; wo oben ist, wurde geraten: die Fotos aufrecht drehen, um sicher zu sein
warn-by-colour = { $a }; darum werden Fotos allein nach Farben zerlegt
warn-no-mask = { $a } hat keinen Umriss und wurde weggelassen: seinen Umriss unter dem Namen des Fotos neben die anderen legen
warn-amid = { $a } % der Merkmale inmitten der Kameras sind in keinem Umriss: Fehlt etwas von der Person, oder steht etwas neben ihr? Die Umrisse ansehen
warn-border = die Person reicht über den Rand von { $a }: Was abgeschnitten ist, fehlt
warn-same-colours = Person und Raum haben dort fast dieselben Farben; die Umrisse ansehen
warn-unlike = der Umriss ist nicht, was die anderen Fotos zeigen; die Umrisse ansehen
warn-page-weight = der Bericht hat { $a } MB, mehr als { $b } MB
warn-no-face = weggelassen, denn wo das Gesicht ist, ist nicht bekannt
warn-mat-about = die Matte wurde erkannt: { $a } Marken, Nummern { $b } bis { $c }, auf einem Ring mit { $d } mm Radius, auf { $e } mm genau ({ $f } % aller Längen): den Radius von der Mitte bis zur Mitte einer Marke messen und zusammen mit den Nummern { $g } bis { $h } angeben
warn-mat-known = die Matte wurde erkannt: { $a } Marken, Nummern { $b } bis { $c }, auf einem Ring mit { $d } mm Radius
warn-mat-no-ring = die Marken auf den Fotos liegen nicht auf einem Ring wie bei einer Matte von `tailor mat`: Sie werden nicht benutzt
warn-mat-odd = die Marken liegen auf einem Ring mit { $a } mm Radius, wenn sie { $b } mm breit sind, und so legt `tailor mat` keine: eine gedruckte Marke noch einmal messen; die Marken werden nicht benutzt
warn-rim-few = Marken am Rand der Scheibe sind angegeben, aber nur { $a } Beobachtungen taugen: Angaben, Licht am Rand und Bildausschnitt prüfen
warn-rim-off = die Marken am Rand liegen { $a } px neben ihrem Platz, die auf der Scheibe { $b } px: Sie wurden weggelassen; eine gedruckte Marke und die Scheibe messen
warn-tags-unused = Marken (Familie 36h11, Nummern { $a } bis { $b }) sind auf { $c } von { $d } abgesuchten Fotos zu sehen, aber nichts ist über sie angegeben, darum werden sie nicht benutzt; { $e }
warn-tags-strange = sie liegen nicht wie bei einer Matte von `tailor mat`: sie abdecken
warn-tags-mat = sie liegen wie bei einer Matte von `tailor mat` ({ $a } Marken auf einem Ring vom { $b }-fachen einer Marke): die gemessene Kante des schwarzen Quadrats einer gedruckten Marke oben angeben
warn-arm-unlike = ein Arm ist anders als die, an denen seine Gelenke bestimmt wurden, darum sind die Bereiche weiter: Ist er bloß, hängt er oder ist er zur Seite gestreckt, und stimmt die Körpergröße?
warn-no-plate = es gibt kein Foto der leeren Szene: Sie wird aus dem erraten, was still steht, und das kann Teile des Körpers kosten; die Umrisse ansehen oder ein Foto ohne die Person aufnehmen und plate.jpg nennen
warn-patch = ein Fleck in einer Farbe, die der Körper sonst nirgends hat, zählt als Körper, wo kein Foto den leeren Raum zeigt: Ist es ein Stück Wand neben Arm oder Rumpf? Umfänge dort können zu groß sein; diese Umrisse ansehen
warn-room-moved = zwischen { $a } und { $b } verschob sich der Raum im Foto um { $c } px: Die Kamera wurde bewegt; weglassen, was davor oder danach aufgenommen wurde, oder die Drehung neu aufnehmen
warn-shows-same = { $a } zeigt dasselbe wie { $b }, dazwischen drehte sich nichts: eines davon weglassen
warn-and-more = und so weiter, { $a } weitere Fotos
warn-no-legs = es wurden keine zwei Beine gefunden: Ist der Körper abgeschnitten, oder verdeckt ein Mantel oder Rock sie?
warn-no-neck = zwischen Kopf und Schultern wurde kein Hals gefunden: Verdecken ihn Haare oder ein Kragen, oder schneiden die Fotos den Kopf ab?
warn-neck-groove = der Hals ist auf der Oberfläche eine Rinne zwischen Kopf und Schultern, zu kurz für ein Maßband: das Kinn heben
warn-no-head = oben ist die Oberfläche flach und kein Scheitel: Der Kopf fehlt oder ist vom Rand der Fotos abgeschnitten
warn-not-upright = Rumpf und Beine sind nicht die eines aufrechten Körpers: Liegt, sitzt oder bückt er sich, oder steht er auf dem Kopf?
warn-no-ground = keine Füße enden am Boden, so dass nichts die Höhen sagt: Ist der Körper abgeschnitten, verdecken Hosen oder ein Mantel die Füße, oder ist der Boden der Kameras falsch?
warn-no-limb = dieses Glied ließ sich nicht bis zum Rumpf verfolgen: es vom Körper weg halten
warn-fused = Glied und Rumpf sind dort auf der Oberfläche eins: das Glied weiter weg halten
warn-no-arms = nirgends steht ein Arm frei vom Rumpf, so dass nichts sagt, ob Arme in diesem Schnitt sind: sie vom Körper weg halten
warn-hand = eine Hand oder ein Unterarm ist dort auf der Oberfläche eins mit dem Körper: die Hände weiter weg halten
warn-thighs-one = die Oberschenkel sind auf der Oberfläche bis weit unter den Schritt eins, so dass ihre dickste Stelle nicht zu sehen ist: mit den Füßen weiter auseinander stehen
warn-no-peak = zwischen den Gelenken ist nirgends die dickste Stelle: Verdeckt sie ein Saum, ein Stiefel oder ein Verband?
warn-no-section = die Oberfläche hat dort keinen geschlossenen Schnitt
warn-no-extreme = dieser Körper ist zwischen den Marken dieser Definition nirgends am schmalsten oder am stärksten: eine andere wählen
warn-out-of-range = der Körper liegt außerhalb derer, an denen die Höhen bestimmt wurden, so dass die Höhe nicht gut genug bekannt ist
warn-too-uncertain = der Bereich wäre weiter als 25 % zu jeder Seite, darum steht hier keine Zahl
