//! Pictures of lines in space, side by side, as SVG.

use super::plot::COLORS;
use pelage::curves::DVec3;
use std::fmt::Write;

/// A line in space.
pub struct Stroke {
    pub points: Vec<DVec3>,
    /// Index into [`COLORS`]; `None` is a pale grey.
    pub color: Option<usize>,
    /// In pixels.
    pub width: f64,
}

/// Lines below a title.
pub struct Panel {
    pub title: String,
    pub strokes: Vec<Stroke>,
}

/// How space is laid on the page, without perspective.
pub struct View {
    /// What points right and what up in the picture: units, perpendicular.
    pub right: DVec3,
    pub up: DVec3,
}

/// Pixels of a panel, of its title and around its lines.
const PANEL: [f64; 2] = [240.0, 320.0];
const TITLE: f64 = 28.0;
const MARGIN: f64 = 14.0;

/// The panels, in rows of `columns`, all at one scale.
pub fn picture(panels: &[Panel], columns: usize, view: &View) -> String {
    let flat = |p: &DVec3| [p.dot(view.right), -p.dot(view.up)];
    let boxes: Vec<Bounds> = panels.iter().map(|panel| Bounds::of(panel, flat)).collect();
    let scale = boxes
        .iter()
        .map(Bounds::scale)
        .fold(f64::INFINITY, f64::min);
    let scale = if scale.is_finite() { scale } else { 1.0 };
    let columns = columns.clamp(1, panels.len().max(1));
    let [width, height] = [
        PANEL[0] * columns as f64,
        PANEL[1] * panels.len().div_ceil(columns) as f64,
    ];
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         width=\"{width}\" height=\"{height}\" font-family=\"sans-serif\" font-size=\"14\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n"
    );
    for (i, (panel, bounds)) in panels.iter().zip(&boxes).enumerate() {
        let corner = [
            PANEL[0] * (i % columns) as f64,
            PANEL[1] * (i / columns) as f64,
        ];
        // Writing to a String cannot fail.
        let _ = draw(&mut text, panel, corner, |p| {
            bounds.place(flat(p), scale, corner)
        });
    }
    text + "</svg>\n"
}

fn draw(
    text: &mut String,
    panel: &Panel,
    corner: [f64; 2],
    place: impl Fn(&DVec3) -> [f64; 2],
) -> std::fmt::Result {
    let (x, y) = (corner[0] + PANEL[0] / 2.0, corner[1] + 18.0);
    let title = &panel.title;
    writeln!(
        text,
        "<text x=\"{x}\" y=\"{y}\" text-anchor=\"middle\">{title}</text>"
    )?;
    for stroke in &panel.strokes {
        let color = stroke.color.map(|i| COLORS[i % COLORS.len()]);
        let [r, g, b] = color.map_or([200; 3], |c| [c.0, c.1, c.2]);
        write!(text, "<polyline points=\"")?;
        for [x, y] in stroke.points.iter().map(&place) {
            write!(text, "{x:.2},{y:.2} ")?;
        }
        writeln!(
            text,
            "\" fill=\"none\" stroke=\"#{r:02x}{g:02x}{b:02x}\" stroke-width=\"{}\" \
             stroke-linejoin=\"round\" stroke-linecap=\"round\"/>",
            stroke.width
        )?;
    }
    Ok(())
}

/// The rectangle of a panel's lines on the page.
struct Bounds {
    low: [f64; 2],
    high: [f64; 2],
}

impl Bounds {
    fn of(panel: &Panel, flat: impl Fn(&DVec3) -> [f64; 2]) -> Self {
        let points = panel.strokes.iter().flat_map(|stroke| &stroke.points);
        let empty = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let (low, high) = points.map(flat).fold(empty, |(low, high), p| {
            (
                [low[0].min(p[0]), low[1].min(p[1])],
                [high[0].max(p[0]), high[1].max(p[1])],
            )
        });
        Self { low, high }
    }

    /// The largest scale at which they fit.
    fn scale(&self) -> f64 {
        let room = [PANEL[0], PANEL[1] - TITLE].map(|side| side - 2.0 * MARGIN);
        // A point fits at any scale.
        let fit = |i: usize| room[i] / (self.high[i] - self.low[i]).max(0.0);
        fit(0).min(fit(1))
    }

    fn place(&self, p: [f64; 2], scale: f64, corner: [f64; 2]) -> [f64; 2] {
        let middle = [PANEL[0] / 2.0, (PANEL[1] + TITLE) / 2.0];
        [0, 1].map(|i| {
            let from_middle = p[i] - (self.low[i] + self.high[i]) / 2.0;
            corner[i] + middle[i] + from_middle * scale
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_stay_in_their_panels_and_keep_their_proportions() {
        let stroke = |size: f64| Stroke {
            points: vec![DVec3::ZERO, DVec3::new(size, 2.0 * size, 7.0)],
            color: Some(0),
            width: 1.0,
        };
        let panel = |size| Panel {
            title: "one".into(),
            strokes: vec![stroke(size)],
        };
        let view = View {
            right: DVec3::X,
            up: DVec3::Y,
        };
        let text = picture(&[panel(1.0), panel(0.5)], 2, &view);
        let lines = text.lines().filter_map(|line| {
            line.split('"')
                .nth(1)
                .filter(|_| line.starts_with("<polyline"))
        });
        let ends: Vec<Vec<f64>> = lines
            .map(|list| {
                list.split([',', ' '])
                    .filter_map(|n| n.parse().ok())
                    .collect()
            })
            .collect();
        let [first, second] = &ends[..] else {
            panic!("{text}")
        };
        for (i, line) in [first, second].into_iter().enumerate() {
            let across = PANEL[0] * i as f64;
            assert!(
                line[0] >= across && line[2] <= across + PANEL[0],
                "{line:?}"
            );
            assert!(line[3] >= TITLE && line[1] <= PANEL[1], "{line:?}");
            assert!(((line[1] - line[3]) / (line[2] - line[0]) - 2.0).abs() < 0.01);
        }
        let ratio = (first[2] - first[0]) / (second[2] - second[0]);
        assert!((ratio - 2.0).abs() < 0.01, "{ratio}");
    }
}
