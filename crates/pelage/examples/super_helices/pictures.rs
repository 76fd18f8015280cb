//! Strands and their fits as SVG.

use crate::methods::{Method, Target};
use pelage::curves::DVec3;
use pelage::curves::super_helix::SuperHelix;
use std::fmt::Write;

/// Width and height of one strand's panel, and of the lines of text above.
const PANEL: [f64; 2] = [150.0, 230.0];
const HEAD: f64 = 40.0;

/// Neighbouring elements have one colour and the other; the target lies beneath.
const COLORS: [&str; 2] = ["#0072b2", "#d55e00"];

/// A row of panels for each method, a column for each target, of as many elements as `fits`
/// say; errors are told under them.
pub fn sheet(columns: &[(&str, &Target)], rows: &[(Method, Vec<SuperHelix>)]) -> String {
    let (width, height) = (
        110.0 + PANEL[0] * columns.len() as f64,
        HEAD + PANEL[1] * rows.len() as f64,
    );
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
    );
    for (i, (name, _)) in columns.iter().enumerate() {
        let x = 110.0 + PANEL[0] * (i as f64 + 0.5);
        text(&mut svg, x, 22.0, name);
    }
    for (r, (method, fits)) in rows.iter().enumerate() {
        let y = HEAD + PANEL[1] * r as f64;
        for (k, word) in method.name().split(", ").enumerate() {
            text(&mut svg, 60.0, y + PANEL[1] / 2.0 + 16.0 * k as f64, word);
        }
        for (i, ((_, target), fit)) in columns.iter().zip(fits).enumerate() {
            panel(&mut svg, [110.0 + PANEL[0] * i as f64, y], target, fit);
        }
    }
    svg.push_str("</svg>\n");
    svg
}

fn panel(svg: &mut String, [left, top]: [f64; 2], target: &Target, fit: &SuperHelix) {
    let flat = |p: &DVec3| [p.x + 0.35 * p.y, p.z + 0.15 * p.y];
    let all = target.places.iter().map(flat);
    let [mut low, mut high] = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for p in all {
        for k in 0..2 {
            low[k] = low[k].min(p[k]);
            high[k] = high[k].max(p[k]);
        }
    }
    let room = [PANEL[0] - 24.0, PANEL[1] - 44.0];
    let scale = (room[0] / (high[0] - low[0])).min(room[1] / (high[1] - low[1]));
    let place = |p: &DVec3| {
        let [x, y] = flat(p);
        [
            left + PANEL[0] / 2.0 + (x - (low[0] + high[0]) / 2.0) * scale,
            top + 10.0 + (high[1] - y) * scale,
        ]
    };
    line(svg, target.places.iter().map(place), "#bbb", 5.0);
    let mut s = 0.0;
    for (i, element) in fit.elements().iter().enumerate() {
        let at = |k: usize| place(&fit.at(s + element.length * k as f64 / 40.0).position);
        line(svg, (0..=40).map(at), COLORS[i % 2], 1.6);
        s += element.length;
    }
    let told = format!(
        "{} el., {:.2} %",
        fit.elements().len(),
        100.0 * target.miss(fit)
    );
    text(svg, left + PANEL[0] / 2.0, top + PANEL[1] - 12.0, &told);
}

fn line(svg: &mut String, points: impl Iterator<Item = [f64; 2]>, color: &str, width: f64) {
    let points = points.fold(String::new(), |mut list, [x, y]| {
        let _ = write!(list, "{x:.1},{y:.1} ");
        list
    });
    let _ = writeln!(
        svg,
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\"/>",
        points.trim_end()
    );
}

fn text(svg: &mut String, x: f64, y: f64, words: &str) {
    let _ = writeln!(
        svg,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"middle\">{words}</text>"
    );
}
