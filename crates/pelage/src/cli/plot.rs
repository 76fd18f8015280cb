//! Plots as SVG.

use anyhow::{Result, anyhow};
use plotters::coord::CoordTranslate;
use plotters::coord::ranged1d::ValueFormatter;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::*;

/// A named run of points.
pub struct Line {
    pub name: String,
    pub points: Vec<(f64, f64)>,
}

/// What the axes say.
pub struct Axes<'a> {
    pub title: &'a str,
    pub x: &'a str,
    pub y: &'a str,
}

/// Colours that people with any colour vision can tell apart (Okabe and Ito).
pub const COLORS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];

type Drawn = Result<(), Box<dyn std::error::Error>>;

/// Lines over logarithmic axes, as the text of an SVG file. All numbers must be above 0.
pub fn logarithmic(axes: &Axes, lines: &[Line]) -> Result<String> {
    svg(|root| {
        let range = |of: fn(&(f64, f64)) -> f64| {
            let [low, high] = ends(lines, of);
            (low / 1.3)..(high * 1.3)
        };
        let (across, up) = (range(|p| p.0), range(|p| p.1));
        let mut chart =
            builder(root, axes).build_cartesian_2d(across.log_scale(), up.log_scale())?;
        mesh(&mut chart, axes)?;
        series(&mut chart, lines, 3)?;
        // Where errors that fall, and rates that fall off, leave room.
        legend(&mut chart, SeriesLabelPosition::LowerLeft)?;
        Ok(())
    })
}

/// Lines over `names`, which have the places 0, 1 and so on, and a logarithmic axis, as the text
/// of an SVG file. All heights must be above 0.
pub fn by_name(axes: &Axes, names: &[&str], lines: &[Line]) -> Result<String> {
    svg(|root| {
        let [low, high] = ends(lines, |p| p.1);
        let across = -0.5..names.len() as f64 - 0.5;
        let up = ((low / 1.3)..(high * 1.3)).log_scale();
        let mut chart = builder(root, axes).build_cartesian_2d(across, up)?;
        let name = |x: &f64| match names.get(x.round() as usize) {
            Some(name) if x.fract() == 0.0 => (*name).to_owned(),
            _ => String::new(),
        };
        chart
            .configure_mesh()
            .disable_x_mesh()
            // One at each whole number, and some between.
            .x_labels(2 * names.len())
            .x_label_formatter(&name)
            .x_desc(axes.x)
            .y_desc(axes.y)
            .light_line_style(BLACK.mix(0.05))
            .draw()?;
        series(&mut chart, lines, 3)?;
        legend(&mut chart, SeriesLabelPosition::LowerLeft)?;
        Ok(())
    })
}

/// Lines over even axes, as the text of an SVG file. All numbers must be finite.
pub fn linear(axes: &Axes, lines: &[Line]) -> Result<String> {
    svg(|root| {
        let range = |of: fn(&(f64, f64)) -> f64| {
            let [low, high] = ends(lines, of);
            // A line that is level needs some room too.
            let room = 0.05 * (high - low).max(1e-9 * high.abs().max(1.0));
            (low - room)..(high + room)
        };
        let (across, up) = (range(|p| p.0), range(|p| p.1));
        let mut chart = builder(root, axes).build_cartesian_2d(across, up)?;
        mesh(&mut chart, axes)?;
        series(&mut chart, lines, 0)?;
        legend(&mut chart, SeriesLabelPosition::UpperLeft)?;
        Ok(())
    })
}

/// The text of what `draw` draws.
fn svg(draw: impl FnOnce(&Area) -> Drawn) -> Result<String> {
    let mut text = String::new();
    let drawn = {
        let root = SVGBackend::with_string(&mut text, (720, 440)).into_drawing_area();
        let filled = root.fill(&WHITE).map_err(Into::into);
        let drawn = filled.and_then(|()| draw(&root));
        drawn.and_then(|()| Ok(root.present()?))
    };
    drawn.map_err(|error| anyhow!("the plot: {error}"))?;
    Ok(text)
}

type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;

fn builder<'a, 'b>(root: &'b Area<'a>, axes: &Axes) -> ChartBuilder<'b, 'b, SVGBackend<'a>>
where
    'a: 'b,
{
    let mut builder = ChartBuilder::on(root);
    builder
        .caption(axes.title, ("sans-serif", 18))
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(64);
    builder
}

/// Draws the axes with what they say.
fn mesh<X, Y>(chart: &mut ChartContext<SVGBackend, Cartesian2d<X, Y>>, axes: &Axes) -> Drawn
where
    X: Ranged<ValueType = f64> + ValueFormatter<f64>,
    Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    chart
        .configure_mesh()
        .x_desc(axes.x)
        .y_desc(axes.y)
        .light_line_style(BLACK.mix(0.05))
        .draw()?;
    Ok(())
}

/// Smallest and largest of a coordinate.
fn ends(lines: &[Line], of: fn(&(f64, f64)) -> f64) -> [f64; 2] {
    let points = || lines.iter().flat_map(|line| &line.points).map(of);
    [
        points().fold(f64::INFINITY, f64::min),
        points().fold(f64::NEG_INFINITY, f64::max),
    ]
}

/// Draws lines with marks of so many pixels.
fn series<'a, C>(
    chart: &mut ChartContext<'a, SVGBackend<'_>, C>,
    lines: &[Line],
    mark: u32,
) -> Drawn
where
    C: CoordTranslate<From = (f64, f64)>,
{
    for (k, line) in lines.iter().enumerate() {
        let color = COLORS[k % COLORS.len()];
        let points = || line.points.iter().copied();
        let path = LineSeries::new(points(), color.stroke_width(2));
        chart
            .draw_series(path)?
            .label(&line.name)
            .legend(move |(x, y)| {
                PathElement::new(vec![(x, y), (x + 16, y)], color.stroke_width(2))
            });
        if mark > 0 {
            let marks = points().map(|p| Circle::new(p, mark, color.filled()));
            chart.draw_series(marks)?;
        }
    }
    Ok(())
}

/// Draws the names of the series.
pub fn legend<'a, B, C>(
    chart: &mut ChartContext<'a, B, C>,
    position: SeriesLabelPosition,
) -> Result<(), DrawingAreaErrorKind<B::ErrorType>>
where
    B: DrawingBackend + 'a,
    C: CoordTranslate,
{
    chart
        .configure_series_labels()
        .position(position)
        .background_style(WHITE.mix(0.85))
        .border_style(BLACK.mix(0.2))
        .draw()
}
