"""Trim ANSUR II to the columns that a model of levels uses: integers, one row a person.

    python3 models/made/trim_survey.py FOLDER models/tables

FOLDER holds ANSUR_II_FEMALE_Public.csv and ANSUR_II_MALE_Public.csv as released. Lengths stay whole millimetres as the
survey took them, weight becomes whole kilograms (the survey's is in 0.1 kg). Women first, then men, each in the
release's order. The same input gives the same bytes.
"""
import csv
import hashlib
import io
import sys
from pathlib import Path

SHA256 = {
    "ANSUR_II_FEMALE_Public.csv": "ed7e800aa97a4d42f8286b988be2fe1883a2e789588169db959864b707d1757a",
    "ANSUR_II_MALE_Public.csv": "2c10580d721799cd7d341733e6aa736b34e29979e75dfbd7aeeb3a757e5e7f4f",
}
LENGTHS = """
stature crotchheight buttockheight axillaheight acromialheight cervicaleheight suprasternaleheight chestheight
tenthribheight iliocristaleheight waistheightomphalion trochanterionheight kneeheightmidpatella wristheight
acromionradialelength radialestylionlength biacromialbreadth bideltoidbreadth chestbreadth waistbreadth hipbreadth
chestdepth waistdepth buttockdepth headlength headbreadth tragiontopofhead
neckcircumference neckcircumferencebase shouldercircumference chestcircumference waistcircumference
buttockcircumference thighcircumference lowerthighcircumference calfcircumference anklecircumference
bicepscircumferenceflexed forearmcircumferenceflexed wristcircumference
""".split()
HEADER = ["sex", "age", "weight", *LENGTHS]
ROWS = 6068


def rows(folder: Path):
    """Every person as a list of whole numbers and the letter f or m; a file other than the release stops it."""
    for name, want in SHA256.items():
        data = (folder / name).read_bytes()
        got = hashlib.sha256(data).hexdigest()
        if got != want:
            sys.exit(f"{name}: sha256 is {got}, not the release's {want}")
        for person in csv.DictReader(io.StringIO(data.decode("latin-1"))):
            sex = {"Female": "f", "Male": "m"}[person["Gender"]]
            yield [sex, int(person["Age"]), round(int(person["weightkg"]) / 10), *(int(person[c]) for c in LENGTHS)]


def main():
    folder, out = Path(sys.argv[1]), Path(sys.argv[2])
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(HEADER)
    people = list(rows(folder))
    table.writerows(people)
    if len(people) != ROWS:
        sys.exit(f"{len(people)} persons, not {ROWS}")
    body = text.getvalue().encode()
    (out / "ansur2.csv").write_bytes(body)
    print(f"{len(people)} persons, {len(HEADER)} columns, {len(body)} bytes, sha256 {hashlib.sha256(body).hexdigest()}")


if __name__ == "__main__":
    main()
