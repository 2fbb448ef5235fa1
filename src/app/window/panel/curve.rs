//! The curve of the error: its axes, whose ends are powers of ten, so that they seldom move.

use egui::{Color32, Rangef, Ui, Vec2b};
use egui_plot::{AxisHints, GridInput, GridMark, Line, Plot, PlotBounds, PlotPoints};

/// Height of the plot, points.
const HEIGHT: f32 = 130.0;

/// Numbers along an axis, at most.
const MOST_MARKS: i32 = 5;

/// Numbers along an axis are shown from this distance on, points: they are chosen so that they don't touch.
const CLOSEST: Rangef = Rangef { min: 10.0, max: 12.0 };

/// Powers of ten along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Decades {
    pub first: i32,
    pub last: i32,
}

impl Decades {
    /// Those around some powers, given as they are or as log10 of numbers; `fallback` where there are none.
    pub fn around(powers: impl Iterator<Item = f64>, fallback: Decades) -> Self {
        let [low, high] = powers.fold([f64::MAX, f64::MIN], |[low, high], p| [low.min(p), high.max(p)]);
        if low > high {
            return fallback;
        }
        let first = low.floor() as i32;
        Self { first, last: (high.ceil() as i32).max(first + 1) }
    }

    /// Decades from one number to the next.
    fn step(self) -> i32 {
        ((self.last - self.first + MOST_MARKS) / MOST_MARKS).max(1)
    }

    /// The powers that get a number: every one, or so few that they don't touch.
    pub fn marks(self) -> Vec<i32> {
        (self.first..=self.last).step_by(self.step() as usize).collect()
    }
}

/// A power of ten in words: 0.001 to 1000 written out, and else 1e-4.
pub fn power(exponent: i32) -> String {
    match exponent {
        0..=3 => 10u32.pow(exponent.unsigned_abs()).to_string(),
        -3..=-1 => format!("{:.*}", exponent.unsigned_abs() as usize, 10f64.powi(exponent)),
        _ => format!("1e{exponent}"),
    }
}

/// Draws it: points are log10 of seconds and of the error. Without points, the axes alone.
pub fn show(ui: &mut Ui, curve: &[[f64; 2]]) {
    let of = |axis: usize| curve.iter().map(move |point| point[axis]);
    let seconds = Decades::around(of(0), Decades { first: -1, last: 1 });
    let error = Decades::around(of(1), Decades { first: -3, last: 0 });
    let marks = |decades: Decades| {
        move |_: GridInput| {
            let step_size = f64::from(decades.step());
            decades.marks().into_iter().map(|power| GridMark { value: f64::from(power), step_size }).collect()
        }
    };
    let named = |unit: &'static str| {
        move |mark: GridMark, _: &std::ops::RangeInclusive<f64>| format!("{}{unit}", power(mark.value.round() as i32))
    };
    // Room beyond the ends, so that their numbers are whole and touch none of the other axis.
    let [x, y] = [(seconds, 0.1), (error, 0.08)].map(|(Decades { first, last }, part)| {
        let beyond = part * f64::from(last - first);
        [f64::from(first) - beyond, f64::from(last) + beyond]
    });
    let bounds = PlotBounds::from_min_max([x[0], y[0]], [x[1], y[1]]);
    Plot::new("error")
        .height(HEIGHT)
        .show_x(false)
        .show_y(false)
        .allow_scroll(false)
        .allow_zoom(false)
        .allow_drag(false)
        .allow_boxed_zoom(false)
        .allow_double_click_reset(false)
        .set_margin_fraction(egui::Vec2::splat(0.04))
        .custom_x_axes(vec![AxisHints::new_x().formatter(named(" s")).label_spacing(CLOSEST)])
        .custom_y_axes(vec![AxisHints::new_y().formatter(named("")).min_thickness(38.0).label_spacing(CLOSEST)])
        .x_grid_spacer(marks(seconds))
        .y_grid_spacer(marks(error))
        .label_formatter(|_| None)
        .show(ui, |plot| {
            plot.set_plot_bounds(bounds);
            plot.set_auto_bounds(Vec2b::FALSE);
            plot.line(Line::new("relMSE", PlotPoints::from(curve.to_vec())).color(Color32::LIGHT_GREEN));
        });
}
