#pragma once
// Pictures of numbers: one panel per technique under its heading, and one legend for all of them below.

#include "lab/app/canvas.h"
#include "lab/techniques/technique.h"

#include <string>
#include <vector>

namespace manylights::lab::app {

struct HeatPanel {
    std::string heading;
    std::vector<float> values; ///< per pixel, row by row; negative: sky, nothing was shaded
};

/// What each of the false-colour pictures of a figure shares.
struct HeatScale {
    std::string title;    ///< what is counted
    double top = 1.0;     ///< the value of the brightest colour; more is shown the same
    double largest = 0.0; ///< of all panels; above top the legend says so
};

/// All panels have the same size.
Canvas heat_figure(const std::vector<HeatPanel>& panels, const HeatScale& scale, int width, int height);

struct StructurePanel {
    std::string heading;
    std::vector<CellClass> classes; ///< per pixel
    Canvas shaded;                  ///< the picture that shows through, dimmed
};

/// Figure 3 of Tiled Light Trees (O'Donnell and Chajdas 2017), in its colours: blue where the tile's pixels walk lists
/// only, green where they walk trees only, white where the tile has both. The three also differ in lightness and along
/// the blue-yellow axis, so they are told apart without seeing red or green. Shares are of the pixels with a class.
Canvas structure_figure(const std::vector<StructurePanel>& panels, int width, int height);

/// Pictures side by side, headings above, nothing below.
Canvas picture_row(const std::vector<std::string>& headings, const std::vector<Canvas>& pictures);

} // namespace manylights::lab::app
