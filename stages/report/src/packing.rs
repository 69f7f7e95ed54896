//! Meshes as few bytes: vertices in the order in which faces first name them, each number as its
//! step from the one before, small numbers in one byte (LEB128). `viewer/unpack.js` reads it.

/// Faces as bytes, and the vertices in the order in which the faces first name them.
///
/// Each corner is written as how far it is behind the newest vertex: 0 is a new one.
pub(crate) fn corners(faces: &[[u32; 3]], vertices: usize) -> (Vec<u8>, Vec<u32>) {
    let mut renamed = vec![u32::MAX; vertices];
    let mut order = Vec::new();
    let mut behind = Vec::with_capacity(faces.len() * 3);
    for v in faces.iter().flatten() {
        let newest = order.len() as u32;
        let name = &mut renamed[*v as usize];
        if *name == u32::MAX {
            *name = newest;
            order.push(*v);
        }
        behind.push(newest - *name);
    }
    (varints(behind.into_iter()), order)
}

/// Rows of numbers as bytes: each number as its step from that of the row before, zigzag.
pub(crate) fn steps<const N: usize>(rows: impl Iterator<Item = [i32; N]>) -> Vec<u8> {
    let mut before = [0; N];
    let mut zigzag = Vec::new();
    for row in rows {
        for i in 0..N {
            let step = row[i] - before[i];
            zigzag.push(((step << 1) ^ (step >> 31)) as u32);
        }
        before = row;
    }
    varints(zigzag.into_iter())
}

/// Seven bits a byte, the lowest first; the high bit is set where more follow.
fn varints(values: impl Iterator<Item = u32>) -> Vec<u8> {
    let mut bytes = Vec::new();
    for mut value in values {
        while value > 127 {
            bytes.push(value as u8 | 128);
            value >>= 7;
        }
        bytes.push(value as u8);
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use proof::Dice;

    /// Reads as the page's script does.
    fn read(bytes: &[u8]) -> Vec<u32> {
        let (mut values, mut value, mut shift) = (Vec::new(), 0, 0);
        for b in bytes {
            value |= u32::from(b & 127) << shift;
            shift += 7;
            if b & 128 == 0 {
                values.push(value);
                (value, shift) = (0, 0);
            }
        }
        values
    }

    /// Up to 300 rows of numbers below a bound.
    fn rows<const N: usize>(dice: &mut Dice, below: u64) -> Vec<[u32; N]> {
        let count = dice.bits() % 300;
        let row = |_| std::array::from_fn(|_| (dice.bits() % below) as u32);
        (0..count).map(row).collect()
    }

    #[test]
    fn faces_come_back_as_they_were() {
        let mut dice = Dice(1);
        for _ in 0..256 {
            let faces: Vec<[u32; 3]> = rows(&mut dice, 500);
            let (bytes, order) = corners(&faces, 500);
            let mut newest = 0;
            let mut back = Vec::new();
            for behind in read(&bytes) {
                back.push(order[(newest - behind) as usize]);
                newest += u32::from(behind == 0);
            }
            assert_eq!(back, faces.as_flattened());
            assert_eq!(newest as usize, order.len());
        }
    }

    #[test]
    fn rows_come_back_as_they_were() {
        let mut dice = Dice(2);
        for _ in 0..256 {
            // Both far and near numbers, of either sign.
            let far: Vec<[u32; 1]> = rows(&mut dice, 140_000);
            let row = |[x]: &[u32; 1]| [*x as i32 - 70_000, (*x % 9) as i32];
            let rows: Vec<[i32; 2]> = far.iter().map(row).collect();
            let mut before = [0i32; 2];
            let mut back = Vec::new();
            for pair in read(&steps(rows.iter().copied())).chunks(2) {
                for i in 0..2 {
                    before[i] += (pair[i] >> 1) as i32 ^ -((pair[i] & 1) as i32);
                }
                back.push(before);
            }
            assert_eq!(back, rows);
        }
    }
}
