//! Common style of all figures: sizes, text, and a palette that colour-blind readers can distinguish. No figure relies
//! on colour alone: each series has its own marker.
//!
//! Palette: M. Okabe, K. Ito, "Color Universal Design", 2008 (without yellow, which is too pale on white).

use plotters::style::{FontDesc, FontFamily, FontStyle, RGBColor, TextStyle};

/// Width of every figure, px: twice the intended display size, because the drawing library rounds coordinates to whole
/// pixels.
pub(super) const WIDTH: u32 = 1600;

const PALETTE: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];

/// Colour of text and axes.
pub(super) const INK: RGBColor = RGBColor(34, 34, 34);
/// Colour of background data: demonstrations, references.
pub(super) const GREY: RGBColor = RGBColor(150, 150, 150);
/// Colour of grid lines.
pub(super) const GRID: RGBColor = RGBColor(226, 226, 226);

/// Colour of series `index`.
pub(super) fn colour(index: usize) -> RGBColor {
    PALETTE[index % PALETTE.len()]
}

/// Text style of `size` px.
pub(super) fn text(size: u32) -> TextStyle<'static> {
    styled(size, FontStyle::Normal)
}

/// Heading style of `size` px.
pub(super) fn heading(size: u32) -> TextStyle<'static> {
    styled(size, FontStyle::Bold)
}

fn styled(size: u32, style: FontStyle) -> TextStyle<'static> {
    TextStyle::from(FontDesc::new(FontFamily::SansSerif, f64::from(size), style)).color(&INK)
}
