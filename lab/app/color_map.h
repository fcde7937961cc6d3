#pragma once
// Colours for numbers: a map whose lightness grows evenly with the value, so that it is read in the right order by
// everyone, in print and by people who do not tell red from green.

#include "lab/app/canvas.h"

namespace manylights::lab::app {

/// value in [0, 1], clamped; NaN gives the lowest colour.
Rgb heat_color(float value);

/// Perceived lightness of a colour (L of Oklab), 0 black to 1 white.
float lightness(Rgb color);

} // namespace manylights::lab::app
