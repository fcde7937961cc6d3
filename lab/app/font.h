#pragma once
// A small bitmap font for legends: capital letters 7 rows high, descenders 2 rows below, each glyph as wide as it is.

#include <cstdint>
#include <string_view>

namespace manylights::lab::app {

constexpr int kFontHeight = 7;  ///< rows from the top of a capital letter to the base line
constexpr int kFontDescent = 2; ///< rows below the base line

/// Pixels that a text takes at scale 1, without a trailing gap.
int text_width(std::string_view text);

/// Calls plot(column, row) for each set pixel of the text at scale 1; characters without a glyph are drawn as '?'.
template <typename Plot>
void for_each_text_pixel(std::string_view text, Plot&& plot);

namespace font_detail {
/// A glyph's used columns; row 0 is the top one, bit 4 of a row its leftmost column.
struct Glyph {
    std::uint8_t rows[kFontHeight + kFontDescent];
    int first_column, width;
};
const Glyph& find_glyph(char character);
constexpr int kGap = 1;
} // namespace font_detail

template <typename Plot>
void for_each_text_pixel(std::string_view text, Plot&& plot) {
    int x = 0;
    for (const char character : text) {
        const font_detail::Glyph& glyph = font_detail::find_glyph(character);
        for (int row = 0; row < kFontHeight + kFontDescent; ++row)
            for (int column = 0; column < glyph.width; ++column)
                if ((glyph.rows[row] >> (4 - glyph.first_column - column)) & 1) plot(x + column, row);
        x += glyph.width + font_detail::kGap;
    }
}

} // namespace manylights::lab::app
