#pragma once
// 8-bit sRGB pixels that can be drawn on. Everything outside of the canvas is clipped.

#include "lab/renderer/tone_map.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace manylights::lab::app {

struct Rgb {
    std::uint8_t r, g, b;
    bool operator==(const Rgb&) const = default;
};

struct Canvas {
    int width = 0, height = 0;
    std::vector<Rgb> pixels; ///< row by row

    Canvas() = default;
    Canvas(int canvas_width, int canvas_height, Rgb fill);
    explicit Canvas(const Picture& picture);
    Picture picture() const;

    const Rgb& at(int x, int y) const;
    void set(int x, int y, Rgb color);
    void fill(int x, int y, int rectangle_width, int rectangle_height, Rgb color);
    void draw(int x, int y, const Canvas& other);
    /// (x, y) is the top left of a capital letter.
    void text(int x, int y, std::string_view content, Rgb color, int scale);
};

} // namespace manylights::lab::app
