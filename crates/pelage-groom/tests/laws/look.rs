//! Colours that differ from hair to hair (document 004, section 2.2.6).

use crate::fixture::{Fixture, collect};
use pelage_groom::color::{hsv_from_rgb, rgb_from_hsv};
use pelage_strands::StrandBuffer;

/// `count` hairs, root at hue 200°, tip at 230°, with more lines.
fn hairs(count: u64, more: &str) -> StrandBuffer {
    let [root, tip] = [[200.0, 0.5, 0.5], [230.0, 0.4, 0.6]].map(rgb_from_hsv);
    let more = format!("color = {{ root = {root:?}, tip = {tip:?}, {more} }}");
    let fixture = Fixture {
        count,
        flat: true,
        more: &more,
        ..Fixture::default()
    };
    collect(&fixture.plan(), 0..count, 2)
}

/// Colours of hair `i` at root and tip.
fn ends(hairs: &StrandBuffer, i: usize) -> [[f32; 3]; 2] {
    let colors = &hairs.colors[hairs.vertices(i)];
    [colors[0], colors[colors.len() - 1]]
}

fn near(a: [f32; 3], b: [f32; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-5)
}

#[test]
fn amounts_of_zero_change_no_bit() {
    let plain = hairs(2000, "");
    let neutral = "mutant = { percent = 0.0, color = [1.0, 0.0, 0.0] }, \
                   variation = { hue = 0.0, saturation = 0.0, value = 0.0 }";
    assert!(plain == hairs(2000, neutral));
}

#[test]
fn the_share_of_mutants_is_the_percentage_and_each_has_one_colour() {
    const GREEN: [f32; 3] = [0.1, 0.8, 0.2];
    for percent in [0.0, 12.5, 100.0] {
        let more = format!("mutant = {{ percent = {percent:?}, color = {GREEN:?} }}");
        let hairs = hairs(100_000, &more);
        let mutants = (0..hairs.len())
            .filter(|&i| hairs.colors[hairs.vertices(i)].iter().all(|&c| c == GREEN))
            .count();
        let spread = 4.0 * (percent * (100.0 - percent) / 100_000.0f64).sqrt();
        let found = mutants as f64 / 1000.0;
        assert!((found - percent).abs() <= spread, "{found} for {percent}");
    }
}

#[test]
fn common_hairs_keep_their_colours_beside_mutants() {
    let plain = ends(&hairs(1, ""), 0);
    let mixed = hairs(1000, "mutant = { percent = 30.0, color = [0.9, 0.1, 0.1] }");
    for i in 0..mixed.len() {
        let found = ends(&mixed, i);
        assert!(found == plain || found == [[0.9, 0.1, 0.1]; 2], "{found:?}");
    }
}

#[test]
fn shifts_are_uniform_within_their_range_and_independent_of_each_other() {
    let more = "variation = { hue = 90.0, saturation = 0.3, value = 0.2 }";
    let hairs = hairs(20_000, more);
    let shifts: Vec<[f64; 3]> = (0..hairs.len())
        .map(|i| {
            let [h, s, v] = hsv_from_rgb(ends(&hairs, i)[0]).map(f64::from);
            [(200.0 - h) / 90.0, (0.5 - s) / 0.3, (0.5 - v) / 0.2]
        })
        .collect();
    for k in 0..3 {
        let mut bins = [0f64; 50];
        for shift in &shifts {
            assert!(shift[k].abs() < 1.0 + 1e-4, "{shift:?}");
            bins[((shift[k] * 25.0 + 25.0) as usize).min(49)] += 1.0;
        }
        let expected = shifts.len() as f64 / 50.0;
        let chi_square: f64 = bins
            .iter()
            .map(|b| (b - expected) * (b - expected) / expected)
            .sum();
        assert!(chi_square < 95.0, "part {k}: {chi_square}");
        let together: f64 = shifts.iter().map(|s| s[k] * s[(k + 1) % 3]).sum();
        let correlation = together * 3.0 / shifts.len() as f64;
        assert!(correlation.abs() < 0.03, "part {k}: {correlation}");
    }
}

#[test]
fn root_and_tip_are_shifted_alike_whatever_space_mixes_them() {
    for space in ["hsv", "oklab", "rgb"] {
        let more = format!("space = '{space}', variation = {{ hue = 60.0, value = 0.1 }}");
        let hairs = hairs(500, &more);
        for i in 0..hairs.len() {
            let [root, tip] = ends(&hairs, i).map(hsv_from_rgb);
            let tolerance = if space == "oklab" { 0.5 } else { 0.05 };
            assert!((tip[0] - root[0] - 30.0).abs() < tolerance, "{space}");
            assert!((tip[1] - 0.4).abs() < 2e-3 && (root[1] - 0.5).abs() < 2e-3);
            assert!((tip[2] - root[2] - 0.1).abs() < 1e-3, "{space}");
        }
    }
}

#[test]
fn a_mutant_is_shifted_too_and_stays_of_one_colour() {
    let more = "mutant = { percent = 100.0, color = [0.2, 0.4, 0.1] }, variation.hue = 40.0";
    let hairs = hairs(500, more);
    let base = hsv_from_rgb([0.2, 0.4, 0.1]);
    let mut moved = 0;
    for i in 0..hairs.len() {
        let [root, tip] = ends(&hairs, i);
        assert!(near(root, tip));
        let found = hsv_from_rgb(root);
        assert!((found[0] - base[0]).abs() <= 40.1 && (found[1] - base[1]).abs() < 1e-4);
        moved += usize::from((found[0] - base[0]).abs() > 1.0);
    }
    assert!(moved > 450, "{moved}");
}

#[test]
fn a_hair_keeps_its_colour_when_there_are_more() {
    let more = "mutant = { percent = 20.0 }, \
                variation = { hue = 50.0, saturation = 0.2, value = 0.2 }";
    let (few, many) = (hairs(1000, more), hairs(3000, more));
    assert_eq!(few.colors[..], many.colors[..few.colors.len()]);
}
