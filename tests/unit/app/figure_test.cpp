#include "lab/app/figure.h"

#include "lab/app/color_map.h"
#include "lab/app/font.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace manylights::lab::app {
namespace {

bool contains(const Canvas& canvas, Rgb color) {
    return std::find(canvas.pixels.begin(), canvas.pixels.end(), color) != canvas.pixels.end();
}

TEST(Font, every_character_of_the_legends_has_a_glyph_of_its_own) {
    const auto pixels_of = [](char character) {
        std::set<std::pair<int, int>> pixels;
        for_each_text_pixel(std::string(1, character), [&](int x, int y) { pixels.insert({x, y}); });
        return pixels;
    };
    const std::string used = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789.,:-+()%_=/?";
    for (const char a : used)
        for (const char b : used)
            if (a < b) {
                EXPECT_NE(pixels_of(a), pixels_of(b)) << a << b;
            }
}

TEST(Font, text_stays_within_its_width) {
    for (const std::string text : {"", "1", "lights tested per pixel", "jig, 12.5%"}) {
        int last = -1;
        for_each_text_pixel(text, [&](int x, int) { last = std::max(last, x); });
        EXPECT_EQ(last + 1, text_width(text)) << text;
    }
}

TEST(Canvas, what_lies_outside_is_clipped) {
    Canvas canvas(4, 3, {1, 2, 3});
    canvas.fill(-5, -5, 100, 6, {9, 9, 9});
    canvas.text(2, 1, "W", {8, 8, 8}, 3);
    canvas.draw(3, 2, Canvas(5, 5, {7, 7, 7}));
    EXPECT_EQ(canvas.at(0, 0), (Rgb{9, 9, 9}));
    EXPECT_EQ(canvas.at(3, 2), (Rgb{7, 7, 7}));
    EXPECT_EQ(canvas.at(0, 2), (Rgb{1, 2, 3}));
}

TEST(Figure, panels_show_the_same_value_in_the_same_color) {
    const HeatPanel low{"a", {0.0f, 10.0f}}, high{"b", {10.0f, 20.0f}};
    const Canvas figure = heat_figure({low, high}, {"title", 20.0, 20.0}, 2, 1);
    // The row that holds the pixels: both panels' colours of 10 are in it.
    int rows_with_two = 0;
    for (int y = 0; y < figure.height; ++y) {
        int tens = 0, zeros = 0, twenties = 0;
        for (int x = 0; x < figure.width; ++x) {
            tens += figure.at(x, y) == heat_color(0.5f);
            zeros += figure.at(x, y) == heat_color(0.0f);
            twenties += figure.at(x, y) == heat_color(1.0f);
        }
        rows_with_two += tens == 2 && zeros == 1 && twenties == 1;
    }
    EXPECT_EQ(rows_with_two, 1);
}

TEST(Figure, sky_is_not_a_color_of_the_scale) {
    const Canvas sky = heat_figure({{"a", {-1.0f}}}, {"title", 20.0, 0.0}, 1, 1);
    const Canvas zero = heat_figure({{"a", {0.0f}}}, {"title", 20.0, 0.0}, 1, 1);
    EXPECT_NE(sky.pixels, zero.pixels);
}

TEST(Figure, every_size_makes_a_figure_that_holds_its_panels) {
    for (const int width : {1, 47, 960, 3840})
        for (const int height : {1, 33, 2160}) {
            const std::vector<float> values(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 2.0f);
            const Canvas figure = heat_figure({{"clustered", values}}, {"lights", 5.0, 2.0}, width, height);
            EXPECT_GE(figure.width, width);
            EXPECT_GT(figure.height, height);
            EXPECT_TRUE(contains(figure, heat_color(0.4f)));
        }
}

TEST(Figure, classes_differ_in_lightness) {
    constexpr int kWidth = 400, kHeight = 200;
    const Canvas white(kWidth, kHeight, {255, 255, 255});
    float before = 0.0f;
    for (const CellClass kind : {CellClass::none, CellClass::list, CellClass::tree, CellClass::mixed}) {
        const std::vector<CellClass> classes(kWidth * kHeight, kind);
        const Canvas figure = structure_figure({{"", classes, white}}, kWidth, kHeight);
        // The picture lies between heading and legend, both lower than it is.
        const float here = lightness(figure.at(kWidth / 2, figure.height / 2));
        EXPECT_GT(here, before + 0.1f) << static_cast<int>(kind);
        before = here;
    }
}

} // namespace
} // namespace manylights::lab::app
