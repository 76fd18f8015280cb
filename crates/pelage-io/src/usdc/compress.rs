//! The two compressions of crate-file sections: bytes, and integers as deltas.

/// Largest input that one LZ4 block may hold in this format.
const LARGEST_BLOCK: usize = 0x7E00_0000;

/// `bytes` as one LZ4 block behind a byte that counts further chunks: 0, as sections
/// are far smaller than [`LARGEST_BLOCK`]. `None` where they are not.
pub(super) fn compress_bytes(bytes: &[u8]) -> Option<Vec<u8>> {
    if bytes.len() > LARGEST_BLOCK {
        return None;
    }
    let mut out = vec![0];
    out.extend(lz4_flex::block::compress(bytes));
    Some(out)
}

/// Integers as differences to their predecessor (the first to 0), then as bytes.
///
/// Encoded: the commonest difference as i32; two bits a value, four values a byte
/// from the lowest bits up, saying how its difference is stored (0 the commonest,
/// 1 i8, 2 i16, 3 i32); then the stored differences.
pub(super) fn compress_integers(values: &[i32]) -> Option<Vec<u8>> {
    let mut before = 0i32;
    let deltas: Vec<i32> = values
        .iter()
        .map(|&value| value.wrapping_sub(std::mem::replace(&mut before, value)))
        .collect();
    let common = commonest(&deltas);
    let mut codes = vec![0u8; deltas.len().div_ceil(4)];
    let mut stored = Vec::new();
    for (i, &delta) in deltas.iter().enumerate() {
        let code = store(delta, common, &mut stored);
        codes[i / 4] |= code << (2 * (i % 4));
    }
    let mut encoded = common.to_le_bytes().to_vec();
    encoded.append(&mut codes);
    encoded.append(&mut stored);
    compress_bytes(&encoded)
}

fn store(delta: i32, common: i32, stored: &mut Vec<u8>) -> u8 {
    if delta == common {
        0
    } else if let Ok(small) = i8::try_from(delta) {
        stored.extend(small.to_le_bytes());
        1
    } else if let Ok(medium) = i16::try_from(delta) {
        stored.extend(medium.to_le_bytes());
        2
    } else {
        stored.extend(delta.to_le_bytes());
        3
    }
}

/// The value met most often; of several the smallest, so that files are the same
/// every time.
fn commonest(values: &[i32]) -> i32 {
    let mut sorted = values.to_vec();
    sorted.sort_unstable();
    let runs = sorted.chunk_by(|a, b| a == b);
    let longest = runs.fold((0, 0), |(value, length), run| {
        if run.len() > length {
            (run[0], run.len())
        } else {
            (value, length)
        }
    });
    longest.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The inverse, as a reader does it.
    fn decode(compressed: &[u8], count: usize) -> Vec<i32> {
        assert_eq!(compressed[0], 0);
        let largest = 4 + count.div_ceil(4) + 4 * count;
        let bytes = lz4_flex::block::decompress(&compressed[1..], largest).unwrap();
        let take = |at: &mut usize, n: usize| {
            *at += n;
            bytes[*at - n..*at].to_vec()
        };
        let mut at = 0;
        let common = i32::from_le_bytes(take(&mut at, 4).try_into().unwrap());
        let codes = take(&mut at, count.div_ceil(4));
        let mut value = 0i32;
        (0..count)
            .map(|i| {
                let delta = match (codes[i / 4] >> (2 * (i % 4))) & 3 {
                    0 => common,
                    1 => i8::from_le_bytes(take(&mut at, 1).try_into().unwrap()).into(),
                    2 => i16::from_le_bytes(take(&mut at, 2).try_into().unwrap()).into(),
                    _ => i32::from_le_bytes(take(&mut at, 4).try_into().unwrap()),
                };
                value = value.wrapping_add(delta);
                value
            })
            .collect()
    }

    proptest! {
        #[test]
        fn integers_survive(values in prop::collection::vec(
            prop_oneof![any::<i32>(), -300..300, Just(-1)], 0..60
        )) {
            let compressed = compress_integers(&values).unwrap();
            prop_assert_eq!(decode(&compressed, values.len()), values);
        }
    }

    #[test]
    fn the_commonest_value_is_the_smallest_of_equals() {
        assert_eq!(commonest(&[]), 0);
        assert_eq!(commonest(&[3, 1, 3, 1, 2]), 1);
        assert_eq!(commonest(&[5, 5, 1]), 5);
    }
}
