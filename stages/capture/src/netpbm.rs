//! Pictures as programs hand them on: Netpbm's binary PGM and PPM, one behind the other.

use std::io::{BufRead, Error, Read, Result};

/// A picture of one or three bytes a pixel, row by row from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Netpbm {
    /// Pixels across.
    pub(crate) width: usize,
    /// Pixels down.
    pub(crate) height: usize,
    /// Bytes a pixel: 1 grey, 3 red, green and blue.
    pub(crate) depth: usize,
    /// The pixels.
    pub(crate) data: Vec<u8>,
}

/// Numbers of a head, sides and levels, are at most this (structural: two bytes).
const LARGEST: usize = 65_535;

/// The next picture; none at the end. Of 8 bits a value.
///
/// # Errors
///
/// What comes is no PGM or PPM, or ends within a picture.
pub(crate) fn read(from: &mut dyn BufRead) -> Result<Option<Netpbm>> {
    if from.fill_buf()?.is_empty() {
        return Ok(None);
    }
    let depth = match word(from)?.as_str() {
        "P5" => 1,
        "P6" => 3,
        other => {
            return Err(Error::other(format!(
                "its answer is no picture ({other:?})"
            )));
        }
    };
    let mut number = || -> Result<usize> {
        let word = word(from)?;
        let number = word.parse().ok().filter(|n| (1..=LARGEST).contains(n));
        number.ok_or_else(|| Error::other(format!("a picture of {word:?} pixels")))
    };
    let (width, height, most) = (number()?, number()?, number()?);
    if most != 255 {
        return Err(Error::other(format!("a picture of {most} levels")));
    }
    let size = width * height * depth;
    let mut data = Vec::with_capacity(size.min(1 << 28));
    from.take(size as u64).read_to_end(&mut data)?;
    if data.len() < size {
        return Err(Error::other("its answer ends within a picture"));
    }
    Ok(Some(Netpbm {
        width,
        height,
        depth,
        data,
    }))
}

/// A word of a head, and the one blank behind it; comments are passed over.
fn word(from: &mut dyn BufRead) -> Result<String> {
    let mut word = String::new();
    loop {
        let mut byte = [0];
        from.read_exact(&mut byte)?;
        match byte[0] {
            b'#' => {
                from.take(4096).read_until(b'\n', &mut Vec::new())?;
            }
            b if b.is_ascii_whitespace() && word.is_empty() => {}
            b if b.is_ascii_whitespace() => return Ok(word),
            b if word.len() < 16 => word.push(char::from(b)),
            _ => return Err(Error::other(format!("its answer is no picture ({word:?})"))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_come_one_behind_the_other() {
        let mut bytes: &[u8] = b"P5\n2 1\n255\nabP6 # a note\n1 1 255\nxyz";
        let one = read(&mut bytes).unwrap().unwrap();
        assert_eq!((one.width, one.height, one.depth), (2, 1, 1));
        assert_eq!(one.data, b"ab");
        let two = read(&mut bytes).unwrap().unwrap();
        assert_eq!((two.depth, two.data.as_slice()), (3, b"xyz".as_slice()));
        assert_eq!(read(&mut bytes).unwrap(), None);
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        for (bytes, part) in [
            ("P5 2 2 255 abc", "ends within"),
            ("P5 2 2 65535 ", "65535 levels"),
            ("P5 99999 2 255 ", "\"99999\" pixels"),
            ("P5 0 2 255 ", "\"0\" pixels"),
            ("P4 2 2 ", "no picture"),
            (
                "HTTP/1.1 200 OK and much more without a blank",
                "no picture",
            ),
        ] {
            let why = read(&mut bytes.as_bytes()).unwrap_err().to_string();
            assert!(why.contains(part), "{bytes}: {why}");
        }
    }
}
