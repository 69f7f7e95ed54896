"""Turns a crate's constants whose origin is not on record into functions that a variable scales; for constants.py.

`const NAME: T = V;` becomes `fn NAME() -> T`, in all files that import it, too, and so do constants that follow from such a one. TRIAL is
`file::NAME=2` for one of them, `file::NAME.1=2` for the second number of a tuple, `*=2` for all; whole numbers are rounded. To the file
TRIAL_READ the names of those are added that a run reads.
"""

import re

CONST = re.compile(r"^(?P<comment>(?://.*\n)+)(?P<vis>(?:pub(?:\([a-z]+\))? )?)const (?P<name>\w+): (?P<kind>[^=]+?) =\s*(?P<value>[^;]+);", re.M)
NUMBER = re.compile(r"(?<![\w.])-?\d[\d_]*(?:\.\d+)?")
SCALED = '{ static OF: std::sync::OnceLock<f64> = std::sync::OnceLock::new(); crate::trial::trial(&OF, "%s", %s) }'
HELPER = """//! Written by docs/tables/constants.py: numbers scaled at run time.
pub(crate) trait Number { fn by(self, factor: f64) -> Self; }
macro_rules! number { ($($t:ty: $end:ident),*) => {$(impl Number for $t {
    fn by(self, factor: f64) -> Self { f64::$end(self as f64 * factor) as $t }
})*} }
number!(f64: from, f32: from, usize: round, u32: round, u64: round, i32: round, i64: round);
pub(crate) fn trial<T: Number>(of: &std::sync::OnceLock<f64>, name: &str, value: T) -> T {
    value.by(*of.get_or_init(|| {
        let of = |variable| std::env::var(variable).unwrap_or_default();
        if let Ok(mut file) = std::fs::OpenOptions::new().append(true).create(true).open(of("TRIAL_READ")) {
            std::io::Write::write_all(&mut file, format!("{name}\\n").as_bytes()).unwrap();
        }
        let trial = of("TRIAL");
        trial.split_once('=').filter(|t| t.0 == name || t.0 == "*").map_or(1.0, |t| t.1.parse().unwrap())
    }))
}
"""


def rewritten(root):
    """Turns a crate's constants that are not on record into functions, and those that follow from them."""
    texts = {path: path.read_text() for path in root.rglob("*.rs") if not path.name.endswith("tests.rs")}
    found = [(path, m["name"], re.sub(r"\s*\n?//+\s*", " ", m["comment"])) for path, text in texts.items() for m in CONST.finditer(text)]
    tried = {(path, name) for path, name, comment in found if "By hand: not on record" in comment}
    todo, done, names = set(tried), set(), []
    while todo - done:
        path, name = here = min(todo - done)
        done.add(here)
        of = path.relative_to(root)

        def scaled(key, value):
            names.append(key)
            return SCALED % (key, value)

        def function(m):
            if m["name"] != name:
                return m[0]
            value, at = m["value"], iter(range(9))
            if here in tried and m["kind"].isalnum():
                value = scaled(f"{of}::{name}", value)
            elif here in tried:
                value = NUMBER.sub(lambda number: f"({scaled(f'{of}::{name}.{next(at)}', number[0])})", value)
            return f"{m['comment']}#[allow(non_snake_case)]\n{m['vis']}fn {name}() -> {m['kind']} {{ {value} }}"

        module = "crate::" + "::".join(of.with_suffix("").parts)
        for p, text in texts.items():
            imported = re.findall(rf"use {module}::([^;]+);", text)
            if p == path or any(re.search(rf"\b{name}\b", some) for some in imported):
                parts = re.split(r"(use [^;]+;|//.*)", CONST.sub(function, text) if p == path else text)
                parts[::2] = [re.sub(rf"(?<!fn )(?<!::)\b{name}\b(?!\()", f"{name}()", part) for part in parts[::2]]
                texts[p] = "".join(parts)
                todo |= {(p, m["name"]) for m in CONST.finditer(texts[p]) if f"{name}()" in m["value"]}
    for path, text in texts.items():
        path.write_text(text + ("mod trial;\n" if path == root / "lib.rs" else ""))
    (root / "trial.rs").write_text(HELPER)
    (root / "trial.txt").write_text("\n".join(names))
