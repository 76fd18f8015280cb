//! Bars cut into parts, for the results, as SVG.

use crate::cli::plot::{COLORS, legend};
use anyhow::{Result, anyhow};
use plotters::coord::ranged1d::SegmentValue;
use plotters::prelude::*;

/// Bars that lie one below the other.
pub struct Bars<'a> {
    pub title: &'a str,
    /// What the lengths are.
    pub x: &'a str,
    /// Names of the parts, in their order in each bar.
    pub parts: &'a [&'a str],
    /// The bars from top to bottom: a name, and the length of each part.
    pub bars: &'a [(String, Vec<f64>)],
}

impl Bars<'_> {
    /// The text of an SVG file.
    pub fn svg(&self) -> Result<String> {
        let mut text = String::new();
        self.draw(&mut text)
            .map_err(|error| anyhow!("the plot: {error}"))?;
        Ok(text)
    }

    fn draw(&self, text: &mut String) -> Result<(), Box<dyn std::error::Error>> {
        let height = 150 + 40 * self.bars.len() as u32;
        let root = SVGBackend::with_string(text, (800, height)).into_drawing_area();
        root.fill(&WHITE)?;
        let longest = self.bars.iter().map(|(_, parts)| parts.iter().sum());
        let longest = longest.fold(f64::MIN_POSITIVE, f64::max);
        let mut chart = ChartBuilder::on(&root)
            .caption(self.title, ("sans-serif", 18))
            .margin(12)
            .x_label_area_size(44)
            .y_label_area_size(210)
            // Room for the legend beside the longest bar.
            .build_cartesian_2d(0.0..longest * 1.35, (0..self.bars.len()).into_segmented())?;
        let name = |at: &SegmentValue<usize>| match at {
            SegmentValue::CenterOf(row) => self.name_of(*row),
            _ => String::new(),
        };
        chart
            .configure_mesh()
            .disable_y_mesh()
            .x_desc(self.x)
            .y_label_formatter(&name)
            .light_line_style(BLACK.mix(0.05))
            .draw()?;
        for (part, name) in self.parts.iter().enumerate() {
            let color = color(part);
            chart
                .draw_series((0..self.bars.len()).map(|row| self.block(row, part)))?
                .label(*name)
                .legend(move |(x, y)| {
                    Rectangle::new([(x, y - 5), (x + 12, y + 5)], color.filled())
                });
        }
        legend(&mut chart, SeriesLabelPosition::MiddleRight)?;
        root.present()?;
        drop(chart);
        drop(root);
        Ok(())
    }

    /// Rows are counted from below, bars from above.
    fn bar(&self, row: usize) -> Option<&(String, Vec<f64>)> {
        self.bars.iter().rev().nth(row)
    }

    fn name_of(&self, row: usize) -> String {
        self.bar(row)
            .map_or(String::new(), |(name, _)| name.clone())
    }

    fn block(&self, row: usize, part: usize) -> Rectangle<(f64, SegmentValue<usize>)> {
        let parts = self.bar(row).map_or(&[][..], |(_, parts)| parts);
        let start: f64 = parts.iter().take(part).sum();
        let end = start + parts.get(part).copied().unwrap_or(0.0);
        let corners = [
            (start, SegmentValue::Exact(row)),
            (end, SegmentValue::Exact(row + 1)),
        ];
        let mut block = Rectangle::new(corners, color(part).filled());
        block.set_margin(10, 10, 0, 0);
        block
    }
}

/// After the last colour they begin anew, paler.
fn color(part: usize) -> RGBAColor {
    let paler = [1.0, 0.55, 0.3][(part / COLORS.len()).min(2)];
    COLORS[part % COLORS.len()].mix(paler)
}
