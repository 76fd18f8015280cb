//! Length preserved: hairs that were bent get the lengths of their segments back.
//!
//! Ours. From the root to the tip, each segment keeps its new direction and gets the
//! length it had. In any space, unit of the mesh.

use pelage_curves::Vec3;

/// Gives the segments of `hair` the lengths of those of `before` times `factor`. A segment
/// that has no length now takes the direction it had too.
pub fn preserve(before: &[Vec3], factor: f32, hair: &mut [Vec3]) {
    let Some(&root) = hair.first() else {
        return;
    };
    let mut start = root;
    let mut end = root;
    for (i, pair) in before.windows(2).enumerate().take(hair.len() - 1) {
        let (was, is) = ((pair[1] - pair[0]) * factor, hair[i + 1] - start);
        start = hair[i + 1];
        end += match is.length() {
            0.0 => was,
            length => is * (was.length() / length),
        };
        hair[i + 1] = end;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn hair() -> impl Strategy<Value = Vec<Vec3>> {
        let vertex = prop::array::uniform3(-2.0f32..2.0).prop_map(Vec3::from);
        prop::collection::vec(vertex, 7)
    }

    proptest! {
        #[test]
        fn every_segment_gets_its_length_and_keeps_its_direction(
            before in hair(), mut bent in hair(), factor in 0.1f32..2.0
        ) {
            let directions: Vec<Vec3> = bent.windows(2).map(|w| w[1] - w[0]).collect();
            let root = bent[0];
            preserve(&before, factor, &mut bent);
            prop_assert_eq!(bent[0], root);
            for ((was, is), direction) in before.windows(2).zip(bent.windows(2)).zip(directions) {
                let expected = was[0].distance(was[1]) * factor;
                prop_assert!((is[0].distance(is[1]) - expected).abs() < 1e-4);
                let aside = (is[1] - is[0]).cross(direction).length();
                prop_assert!(aside < 1e-3 * (1.0 + expected * direction.length()));
            }
        }
    }

    #[test]
    fn a_segment_without_length_takes_the_one_it_had() {
        let before = [Vec3::ZERO, Vec3::Z, Vec3::Z * 2.0];
        let mut hair = [Vec3::ZERO, Vec3::ZERO, Vec3::X];
        preserve(&before, 1.0, &mut hair);
        assert_eq!(hair, [Vec3::ZERO, Vec3::Z, Vec3::Z + Vec3::X]);
    }
}
