//! Log-log plots as SVG, by hand: for the figures in `docs/`.

use crate::convergence::Series;
use std::fmt::Write;
use std::ops::Range;

/// What is drawn.
#[derive(Clone, Debug)]
pub struct Plot<'a> {
    /// Heading.
    pub title: &'a str,
    /// Name of the horizontal axis, which is in powers of two.
    pub x: &'a str,
    /// Name of the vertical axis, which is in powers of ten and labelled in per cent.
    pub y: &'a str,
    /// Series with their colours; each is drawn with its fitted line.
    pub series: &'a [(Series, &'a str)],
}

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 480.0;
/// Corners of the frame: left, right, top, bottom.
const LEFT: f64 = 96.0;
const RIGHT: f64 = 736.0;
const TOP: f64 = 56.0;
const BOTTOM: f64 = 412.0;

/// Maps values to places in the picture.
struct Axes {
    /// Powers of two.
    x: Range<f64>,
    /// Powers of ten.
    y: Range<f64>,
}

impl Axes {
    fn around(plot: &Plot) -> Self {
        let points = || plot.series.iter().flat_map(|(s, _)| &s.points);
        let span = |values: &mut dyn Iterator<Item = f64>| {
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
        };
        let (left, right) = span(&mut points().map(|p| p.0.log2()));
        let (bottom, top) = span(&mut points().map(|p| p.1.log10()));
        Axes { x: left - 0.4..right + 0.4, y: bottom.floor()..top.ceil() }
    }
    fn x(&self, v: f64) -> f64 {
        LEFT + (v.log2() - self.x.start) / (self.x.end - self.x.start) * (RIGHT - LEFT)
    }
    fn y(&self, v: f64) -> f64 {
        BOTTOM - (v.log10() - self.y.start) / (self.y.end - self.y.start) * (BOTTOM - TOP)
    }
}

/// Draws the plot.
pub fn svg(plot: &Plot) -> String {
    let axes = Axes::around(plot);
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = draw(&mut out, plot, &axes);
    out
}

fn draw(out: &mut String, plot: &Plot, axes: &Axes) -> std::fmt::Result {
    writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" \
         font-family=\"system-ui, 'Segoe UI', 'DejaVu Sans', sans-serif\" font-size=\"13\" fill=\"#333\">"
    )?;
    writeln!(out, "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>")?;
    writeln!(out, "<text x=\"{LEFT}\" y=\"32\" font-size=\"17\" font-weight=\"600\">{}</text>", plot.title)?;
    grid(out, axes)?;
    let (middle, centre) = ((LEFT + RIGHT) / 2.0, (TOP + BOTTOM) / 2.0);
    writeln!(out, "<text x=\"{middle}\" y=\"456\" text-anchor=\"middle\">{}</text>", plot.x)?;
    writeln!(
        out,
        "<text transform=\"translate(22 {centre}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
        plot.y
    )?;
    for (series, color) in plot.series {
        curve(out, series, color, axes)?;
    }
    legend(out, plot)?;
    writeln!(out, "</svg>")
}

/// Grid lines and the numbers beside them.
fn grid(out: &mut String, axes: &Axes) -> std::fmt::Result {
    let mut line = |from: (f64, f64), to: (f64, f64), color: &str| {
        let ((x1, y1), (x2, y2)) = (from, to);
        writeln!(
            out,
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{color}\"/>"
        )
    };
    let decades = axes.y.start as i32..=axes.y.end as i32;
    for decade in decades.clone() {
        for k in 2..10 {
            let v = f64::from(k) * 10f64.powi(decade);
            if v.log10() < axes.y.end {
                line((LEFT, axes.y(v)), (RIGHT, axes.y(v)), "#f2f2f2")?;
            }
        }
    }
    for decade in decades.clone() {
        let y = axes.y(10f64.powi(decade));
        line((LEFT, y), (RIGHT, y), "#d0d0d0")?;
    }
    let powers = axes.x.start.ceil() as i32..=axes.x.end as i32;
    for power in powers.clone() {
        let x = axes.x(2f64.powi(power));
        line((x, TOP), (x, BOTTOM), if power % 2 == 0 { "#d0d0d0" } else { "#f2f2f2" })?;
    }
    writeln!(
        out,
        "<rect x=\"{LEFT}\" y=\"{TOP}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#888\"/>",
        RIGHT - LEFT,
        BOTTOM - TOP
    )?;
    for power in powers.filter(|p| p % 2 == 0) {
        let x = axes.x(2f64.powi(power));
        writeln!(out, "<text x=\"{x:.1}\" y=\"430\" text-anchor=\"middle\">{}</text>", 1u64 << power)?;
    }
    for decade in decades {
        let y = axes.y(10f64.powi(decade)) + 4.5;
        let digits = usize::try_from(-2 - decade).unwrap_or(0);
        let percent = 100.0 * 10f64.powi(decade);
        writeln!(
            out,
            "<text x=\"{}\" y=\"{y:.1}\" text-anchor=\"end\">{percent:.digits$} %</text>",
            LEFT - 8.0
        )?;
    }
    Ok(())
}

/// Points, and the fitted line behind them.
fn curve(out: &mut String, series: &Series, color: &str, axes: &Axes) -> std::fmt::Result {
    let fit = series.fit();
    let end = |p: Option<&(f64, f64)>| p.map_or(1.0, |p| p.0);
    let (first, last) = (end(series.points.first()), end(series.points.last()));
    let at = |n: f64| (axes.x(n), axes.y(fit.scale * n.powf(fit.slope)));
    let ((x1, y1), (x2, y2)) = (at(first), at(last));
    writeln!(
        out,
        "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{color}\" stroke-width=\"1.5\" \
         stroke-dasharray=\"6 4\" opacity=\"0.75\"/>"
    )?;
    for &(n, error) in &series.points {
        let (x, y) = (axes.x(n), axes.y(error));
        writeln!(
            out,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"{color}\" stroke=\"#fff\" stroke-width=\"1\"/>"
        )?;
    }
    Ok(())
}

/// Names and slopes, bottom left, where falling curves leave room.
fn legend(out: &mut String, plot: &Plot) -> std::fmt::Result {
    let rows = plot.series.len() as f64;
    let (x, height) = (LEFT + 16.0, 24.0 * rows + 12.0);
    let top = BOTTOM - 16.0 - height;
    writeln!(
        out,
        "<rect x=\"{x}\" y=\"{top}\" width=\"300\" height=\"{height}\" rx=\"4\" fill=\"#fff\" stroke=\"#ccc\"/>"
    )?;
    for (i, (series, color)) in plot.series.iter().enumerate() {
        let y = top + 23.0 + 24.0 * i as f64;
        let slope = format!("{:.2}", series.fit().slope).replace('-', "−");
        let (left, right, dot) = (x + 12.0, x + 44.0, x + 28.0);
        let line_y = y - 4.5;
        writeln!(
            out,
            "<line x1=\"{left}\" y1=\"{line_y}\" x2=\"{right}\" y2=\"{line_y}\" stroke=\"{color}\" stroke-width=\"1.5\" \
             stroke-dasharray=\"6 4\"/><circle cx=\"{dot}\" cy=\"{line_y}\" r=\"4\" fill=\"{color}\"/>"
        )?;
        writeln!(out, "<text x=\"{}\" y=\"{y}\">{}, slope {slope}</text>", right + 10.0, series.name)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plot_has_every_point_and_slope() {
        let points = vec![(1.0, 0.1), (4.0, 0.05), (16.0, 0.025)];
        let series = Series { name: "fine".into(), points };
        let drawn = svg(&Plot { title: "title", x: "samples", y: "error", series: &[(series, "#123456")] });
        assert_eq!(drawn.matches("<circle").count(), 3 + 1);
        assert!(
            drawn.contains("fine, slope −0.50")
                && drawn.contains(">16</text>")
                && drawn.contains(">1 %</text>"),
            "{drawn}"
        );
        assert!(drawn.starts_with("<svg") && drawn.trim_end().ends_with("</svg>"));
        assert!(!drawn.contains("NaN") && !drawn.contains("inf"));
    }
}
