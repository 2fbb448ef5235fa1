//! Error against time, and against samples: log-log, as SVG that prints well.
//!
//! Lines differ in colour (Okabe, Ito 2008: told apart by the colour-blind), in dashes and in markers, so that they do in
//! grey too. The band around a line is from the least to the greatest error.

use std::fmt::Write;

/// What the error is drawn against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    Seconds,
    Samples,
}

/// The drawing's units are points: 1/72 inch.
const WIDTH: f64 = 440.0;
const HEIGHT: f64 = 330.0;
const LEFT: f64 = 58.0;
const RIGHT: f64 = 428.0;
const TOP: f64 = 44.0;
const BOTTOM: f64 = 284.0;

/// Decades beyond the data on each side.
const MARGIN: f64 = 0.12;

/// Colour and dashes of each line in turn.
const STYLES: [(&str, &str); 8] = [
    ("#0072b2", ""),
    ("#d55e00", "7 3"),
    ("#009e73", "2 2.5"),
    ("#000000", "8 3 2 3"),
    ("#cc79a7", "12 3"),
    ("#e69f00", "4 2"),
    ("#56b4e9", "8 2 2 2 2 2"),
    ("#7f7f7f", "1 2"),
];

/// A point of a line: x, mean, least and greatest error.
pub type Point = (f64, f64, f64, f64);

/// What is drawn as one line.
#[derive(Clone, Debug)]
pub struct Line {
    pub name: String,
    pub points: Vec<Point>,
}

/// One axis: powers of ten at its ends, and where those are in the drawing.
#[derive(Clone, Copy)]
struct Scale {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Scale {
    /// Of all values, a little margin around them, and at least a decade.
    fn around(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        let (low, high) =
            values.map(f64::log10).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        let lack = ((1.0 - 2.0 * MARGIN - (high - low)) / 2.0).max(0.0);
        Self { low: low - MARGIN - lack, high: high + MARGIN + lack, from, to }
    }

    /// Of a decimal logarithm.
    fn at(&self, log: f64) -> f64 {
        self.from + (log - self.low) / (self.high - self.low) * (self.to - self.from)
    }

    fn of(&self, value: f64) -> f64 {
        self.at(value.log10())
    }

    fn holds(&self, log: f64) -> bool {
        (self.low - 1e-9..=self.high + 1e-9).contains(&log)
    }

    /// Ticks: their logarithms, and whether they are whole decades.
    fn ticks(&self) -> impl Iterator<Item = (f64, bool)> {
        let decades = self.low.floor() as i32..=self.high.floor() as i32;
        let all = decades.flat_map(|decade| (1..10).map(move |digit| (decade, digit)));
        let scale = *self;
        all.map(|(decade, digit)| (f64::from(decade) + f64::from(digit).log10(), digit == 1))
            .filter(move |(log, _)| scale.holds(*log))
    }
}

/// The plot of some lines; none where no error is above 0. The title is in bold, the line below it is plain.
pub fn svg(title: &str, about: &str, mut lines: Vec<Line>, axis: Axis) -> Option<String> {
    lines.iter_mut().for_each(|line| line.points.retain(|point| point.0 > 0.0 && point.2 > 0.0));
    let points = || lines.iter().flat_map(|line| &line.points);
    points().next()?;
    let x = Scale::around(points().map(|point| point.0), LEFT, RIGHT);
    let y = Scale::around(points().flat_map(|point| [point.2, point.3]), BOTTOM, TOP);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}pt\" height=\"{HEIGHT}pt\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" \
         font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\" font-size=\"9\" fill=\"#222\">\n\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#fff\"/>\n"
    );
    out += &format!(
        "<text x=\"{LEFT}\" y=\"20\" font-size=\"12\" font-weight=\"bold\">{}</text>\n\
         <text x=\"{LEFT}\" y=\"34\" fill=\"#555\">{}</text>\n",
        escaped(title),
        escaped(about),
    );
    out += &grid(x, y);
    out += &guides(x, y);
    let styled = || lines.iter().enumerate().map(|(i, line)| (line, i % STYLES.len()));
    styled().for_each(|(line, style)| out += &band(line, style, x, y));
    styled().for_each(|(line, style)| out += &curve(line, style, x, y));
    out += &frame(x, y, axis);
    out += &legend(&lines);
    Some(out + "</svg>\n")
}

/// Light lines at whole decades.
fn grid(x: Scale, y: Scale) -> String {
    let mut out = String::from("<g stroke=\"#e4e4e4\" stroke-width=\"0.6\">\n");
    for at in x.ticks().filter(|tick| tick.1).map(|tick| x.at(tick.0)) {
        let _ = writeln!(out, "<path d=\"M{at:.2} {TOP}V{BOTTOM}\"/>");
    }
    for at in y.ticks().filter(|tick| tick.1).map(|tick| y.at(tick.0)) {
        let _ = writeln!(out, "<path d=\"M{LEFT} {at:.2}H{RIGHT}\"/>");
    }
    out + "</g>\n"
}

/// Lines of slope -1, a decade apart: along one, twice the work halves the error. They end at the frame, for some programs draw nothing
/// that is clipped.
fn guides(x: Scale, y: Scale) -> String {
    let mut out = String::from("<g stroke=\"#a8a8a8\" stroke-width=\"0.6\" stroke-dasharray=\"1 3\">\n");
    let sums = (x.low + y.low).floor() as i32..=(x.high + y.high).ceil() as i32;
    for sum in sums.map(f64::from) {
        let (left, right) = (x.low.max(sum - y.high), x.high.min(sum - y.low));
        if left >= right {
            continue;
        }
        let [x0, y0, x1, y1] = [x.at(left), y.at(sum - left), x.at(right), y.at(sum - right)];
        let _ = writeln!(out, "<path d=\"M{x0:.2} {y0:.2}L{x1:.2} {y1:.2}\"/>");
    }
    out + "</g>\n"
}

fn band(line: &Line, style: usize, x: Scale, y: Scale) -> String {
    let upper = line.points.iter().map(|p| (p.0, p.3));
    let lower = line.points.iter().rev().map(|p| (p.0, p.2));
    let corners: Vec<String> = upper.chain(lower).map(|(px, py)| format!("{:.2},{:.2}", x.of(px), y.of(py))).collect();
    format!("<polygon points=\"{}\" fill=\"{}\" fill-opacity=\"0.13\"/>\n", corners.join(" "), STYLES[style].0)
}

fn curve(line: &Line, style: usize, x: Scale, y: Scale) -> String {
    let places: Vec<(f64, f64)> = line.points.iter().map(|p| (x.of(p.0), y.of(p.1))).collect();
    let text: Vec<String> = places.iter().map(|(px, py)| format!("{px:.2},{py:.2}")).collect();
    let mut out = stroke(&text.join(" "), style);
    for (px, py) in places {
        out += &marker(px, py, style);
    }
    out
}

fn stroke(points: &str, style: usize) -> String {
    let (colour, dashes) = STYLES[style];
    let dashes = if dashes.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{dashes}\"") };
    format!(
        "<polyline points=\"{points}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.4\" stroke-linejoin=\"round\"{dashes}/>\n"
    )
}

/// Disc, square, triangle or diamond; the fifth to eighth style has them hollow.
fn marker(x: f64, y: f64, style: usize) -> String {
    let shape = match style % 4 {
        0 => format!("<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"2.7\""),
        1 => format!("<rect x=\"{:.2}\" y=\"{:.2}\" width=\"4.8\" height=\"4.8\"", x - 2.4, y - 2.4),
        2 => format!("<path d=\"M{x:.2} {:.2}l3.1 5.4h-6.2z\"", y - 3.5),
        _ => format!("<path d=\"M{x:.2} {:.2}l3.5 3.5l-3.5 3.5l-3.5 -3.5z\"", y - 3.5),
    };
    let colour = STYLES[style].0;
    match style < 4 {
        true => format!("{shape} fill=\"{colour}\" stroke=\"#fff\" stroke-width=\"0.5\"/>\n"),
        false => format!("{shape} fill=\"#fff\" stroke=\"{colour}\" stroke-width=\"1.2\"/>\n"),
    }
}

/// The box with its ticks and their labels.
fn frame(x: Scale, y: Scale, axis: Axis) -> String {
    let mut out = format!(
        "<g stroke=\"#444\" stroke-width=\"0.8\" fill=\"none\">\n<rect x=\"{LEFT}\" y=\"{TOP}\" width=\"{}\" height=\"{}\"/>\n",
        RIGHT - LEFT,
        BOTTOM - TOP
    );
    for (log, whole) in x.ticks() {
        let _ = writeln!(out, "<path d=\"M{:.2} {BOTTOM}v{}\"/>", x.at(log), if whole { -5.5 } else { -2.8 });
    }
    for (log, whole) in y.ticks() {
        let _ = writeln!(out, "<path d=\"M{LEFT} {:.2}h{}\"/>", y.at(log), if whole { 5.5 } else { 2.8 });
    }
    out += "</g>\n";
    for (log, _) in labelled(x) {
        let _ = writeln!(
            out,
            "<text x=\"{:.2}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
            x.at(log),
            BOTTOM + 14.0,
            number(log)
        );
    }
    for (log, _) in labelled(y) {
        let _ = writeln!(
            out,
            "<text x=\"{}\" y=\"{:.2}\" text-anchor=\"end\">{}</text>",
            LEFT - 6.0,
            y.at(log) + 3.2,
            number(log)
        );
    }
    let name = match axis {
        Axis::Seconds => "time of tracing (s)",
        Axis::Samples => "samples per pixel (spp)",
    };
    let (middle, centre) = ((LEFT + RIGHT) / 2.0, (TOP + BOTTOM) / 2.0);
    let _ = writeln!(
        out,
        "<text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\" font-size=\"10\">{name}</text>",
        BOTTOM + 32.0
    );
    let _ = writeln!(
        out,
        "<text transform=\"translate(16 {centre}) rotate(-90)\" text-anchor=\"middle\" font-size=\"10\">relMSE (dimensionless)</text>"
    );
    out
}

/// Whole decades; where those are fewer than two, twos and fives as well.
fn labelled(scale: Scale) -> Vec<(f64, bool)> {
    let whole: Vec<(f64, bool)> = scale.ticks().filter(|tick| tick.1).collect();
    if whole.len() >= 2 {
        return whole;
    }
    let digit = |log: f64| 10f64.powf(log - log.floor()).round() as u32;
    scale.ticks().filter(|tick| tick.1 || matches!(digit(tick.0), 2 | 5)).collect()
}

/// A value as users write it, from 0.01 to 10,000, else a power of ten.
fn number(log: f64) -> String {
    let whole = (log + 1e-9).floor();
    let digit = 10f64.powf(log - whole).round();
    match (whole, digit) {
        (-2.0..=4.0, _) => format!("{}", (digit * 10f64.powf(whole) * 1e4).round() / 1e4),
        (_, 1.0) => format!("10{}", raised(whole)),
        _ => format!("{digit}·10{}", raised(whole)),
    }
}

fn raised(exponent: f64) -> String {
    let sign = if exponent < 0.0 { "−" } else { "" };
    format!("<tspan dy=\"-3.4\" font-size=\"6.5\">{sign}{}</tspan>", exponent.abs())
}

/// Names of the lines, top right, where falling curves leave room.
fn legend(lines: &[Line]) -> String {
    let longest = lines.iter().map(|line| line.name.chars().count()).max().unwrap_or(0) as f64;
    let (row, sample) = (12.5, 30.0);
    // Helvetica's letters are half an em wide on average, at 9 points.
    let width = sample + 18.0 + longest * 4.7;
    let height = row * (lines.len() + 1) as f64 + 7.0;
    let (left, top) = (RIGHT - width - 7.0, TOP + 7.0);
    let mut out = format!(
        "<rect x=\"{left:.2}\" y=\"{top:.2}\" width=\"{width:.2}\" height=\"{height:.2}\" rx=\"2\" fill=\"#fff\" \
         fill-opacity=\"0.92\" stroke=\"#ccc\" stroke-width=\"0.6\"/>\n"
    );
    let place = |i: usize| (left + 7.0, top + 10.0 + row * i as f64);
    for (i, line) in lines.iter().enumerate() {
        let ((x, y), style) = (place(i), i % STYLES.len());
        out += &stroke(&format!("{x:.2},{y:.2} {:.2},{y:.2}", x + sample), style);
        out += &marker(x + sample / 2.0, y, style);
        let _ =
            writeln!(out, "<text x=\"{:.2}\" y=\"{:.2}\">{}</text>", x + sample + 6.0, y + 3.1, escaped(&line.name));
    }
    let (x, y) = place(lines.len());
    let _ = writeln!(
        out,
        "<path d=\"M{x:.2} {y:.2}h{sample}\" stroke=\"#a8a8a8\" stroke-width=\"0.8\" stroke-dasharray=\"1 3\"/>\n\
         <text x=\"{:.2}\" y=\"{:.2}\" fill=\"#777\">slope −1</text>",
        x + sample + 6.0,
        y + 3.1
    );
    out
}

/// Text as XML takes it.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
