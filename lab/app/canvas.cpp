#include "lab/app/canvas.h"

#include "lab/app/font.h"

#include <algorithm>

namespace manylights::lab::app {

Canvas::Canvas(int canvas_width, int canvas_height, Rgb fill_color)
    : width(canvas_width), height(canvas_height),
      pixels(static_cast<std::size_t>(canvas_width) * static_cast<std::size_t>(canvas_height), fill_color) {}

Canvas::Canvas(const Picture& picture)
    : Canvas(static_cast<int>(picture.width), static_cast<int>(picture.height), Rgb{0, 0, 0}) {
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = {picture.rgb.at(3 * i), picture.rgb.at(3 * i + 1), picture.rgb.at(3 * i + 2)};
}

Picture Canvas::picture() const {
    Picture result{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
    result.rgb.reserve(3 * pixels.size());
    for (const Rgb& pixel : pixels) result.rgb.insert(result.rgb.end(), {pixel.r, pixel.g, pixel.b});
    return result;
}

const Rgb& Canvas::at(int x, int y) const {
    return pixels.at(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
}

void Canvas::set(int x, int y, Rgb color) {
    if (x < 0 || y < 0 || x >= width || y >= height) return;
    pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] = color;
}

void Canvas::fill(int x, int y, int rectangle_width, int rectangle_height, Rgb color) {
    for (int row = std::max(0, y); row < std::min(height, y + rectangle_height); ++row)
        for (int column = std::max(0, x); column < std::min(width, x + rectangle_width); ++column)
            set(column, row, color);
}

void Canvas::draw(int x, int y, const Canvas& other) {
    for (int row = 0; row < other.height; ++row)
        for (int column = 0; column < other.width; ++column) set(x + column, y + row, other.at(column, row));
}

void Canvas::text(int x, int y, std::string_view content, Rgb color, int scale) {
    for_each_text_pixel(content,
                        [&](int column, int row) { fill(x + column * scale, y + row * scale, scale, scale, color); });
}

} // namespace manylights::lab::app
