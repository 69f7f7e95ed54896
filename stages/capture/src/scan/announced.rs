//! How many faces a file announces, read from its head alone: what holds too many is refused before it takes memory.

use super::file::ending;

/// A head of a PLY file is at most so long (structural: a hundred times that of a scanner's file).
const HEAD: usize = 1 << 16;

/// The number of faces that a file announces; nought where its format announces none.
pub(crate) fn announced(name: &str, bytes: &[u8]) -> usize {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(HEAD)]);
    match ending(name) {
        Some("ply") => {
            let lines = head.lines().take_while(|line| line.trim() != "end_header");
            let count = |line: &str| {
                line.trim()
                    .strip_prefix("element face")?
                    .trim()
                    .parse()
                    .ok()
            };
            lines.filter_map(count).next().unwrap_or(0)
        }
        Some("stl") => {
            let count = bytes.get(80..84).and_then(|b| b.try_into().ok());
            let count = count.map_or(0, |b| u32::from_le_bytes(b) as usize);
            match count.checked_mul(50).is_some_and(|n| n + 84 == bytes.len()) {
                true => count,
                false => lines_of(bytes, b"facet"),
            }
        }
        Some("off") => {
            let numbers = head
                .lines()
                .map(|line| line.split('#').next().unwrap_or(""));
            let mut words = numbers.flat_map(str::split_whitespace).skip(2);
            words.next().and_then(|word| word.parse().ok()).unwrap_or(0)
        }
        Some("obj") => lines_of(bytes, b"f"),
        _ => 0,
    }
}

/// Lines of a text that begin with a word.
fn lines_of(bytes: &[u8], word: &[u8]) -> usize {
    let begins = |line: &&[u8]| {
        let rest = line.trim_ascii_start().strip_prefix(word);
        rest.is_some_and(|rest| rest.first().is_some_and(u8::is_ascii_whitespace))
    };
    bytes.split(|b| *b == b'\n').filter(begins).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_format_that_announces_its_faces_is_read() {
        let ply = b"ply\nformat ascii 1.0\nelement vertex 3\nelement face 10000000\nproperty x\nend_header\n";
        assert_eq!(announced("a.ply", ply), 10_000_000);
        assert_eq!(announced("a.off", b"OFF # all\n3 7 0\n0 0 0\n"), 7);
        assert_eq!(announced("a.off", b"OFF 3 8 0\n"), 8);
        assert_eq!(announced("a.obj", b"v 0 0 0\nf 1 2 3\n f 1 2 3\nfoo\n"), 2);
        assert_eq!(
            announced("a.stl", b"solid\n facet normal\nendfacet\n facet normal\n"),
            2
        );
        let mut stl = vec![0u8; 84 + 100];
        stl[80] = 2;
        assert_eq!(announced("a.stl", &stl), 2);
        assert_eq!(announced("a.glb", b"glTF"), 0);
        assert_eq!(announced("a.ply", b""), 0);
    }
}
