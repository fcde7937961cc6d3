#include "lab/app/figure.h"

#include "lab/app/color_map.h"
#include "lab/app/font.h"
#include "lab/app/number_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace manylights::lab::app {
namespace {

constexpr Rgb kPaper{18, 18, 22}, kInk{236, 236, 232}, kFaint{150, 150, 152}, kSky{74, 76, 80};
constexpr int kLeastLegendWidth = 300; ///< a narrower picture gets a wider frame, so that its legend can be read

/// Distances of a figure, from one text scale.
struct Layout {
    int panel_width, panel_height, panels;
    int text, margin, heading, legend;
    int width, height;

    int panel_x(int i) const { return (width - row_width()) / 2 + i * (panel_width + margin); }
    int row_width() const { return panels * panel_width + (panels - 1) * margin; }
    int legend_y() const { return heading + panel_height; }
};

Layout make_layout(int panel_width, int panel_height, std::size_t panels, int legend_rows) {
    Layout layout{};
    layout.panel_width = panel_width;
    layout.panel_height = panel_height;
    layout.panels = static_cast<int>(panels);
    // Larger where there are several panels: such a picture is looked at as a whole.
    layout.text = std::clamp((std::max(panel_width, panel_height) + 220) / 480 + (panels > 1 ? 1 : 0), 1, 4);
    layout.margin = 4 * layout.text;
    layout.heading = (kFontHeight + kFontDescent + 8) * layout.text;
    layout.legend = legend_rows * layout.text;
    layout.width = std::max(layout.row_width(), kLeastLegendWidth);
    layout.height = layout.heading + panel_height + layout.legend;
    return layout;
}

Canvas make_figure(const Layout& layout) { return {layout.width, layout.height, kPaper}; }

void draw_heading(Canvas& figure, const Layout& layout, int panel, const std::string& heading) {
    figure.text(layout.panel_x(panel) + layout.margin, 5 * layout.text, heading, kInk, layout.text);
}

Canvas heat_picture(const HeatPanel& panel, double top, int width, int height) {
    Canvas picture(width, height, kSky);
    for (std::size_t i = 0; i < panel.values.size(); ++i)
        if (panel.values[i] >= 0.0f) picture.pixels.at(i) = heat_color(panel.values[i] / static_cast<float>(top));
    return picture;
}

/// A swatch and its words; hands back where the next one may start.
int draw_key(Canvas& figure, int x, int y, int scale, Rgb color, const std::string& words) {
    const int side = 9 * scale;
    figure.fill(x, y - scale, side, side, kInk);
    figure.fill(x + scale, y, side - 2 * scale, side - 2 * scale, color);
    figure.text(x + side + 4 * scale, y, words, kInk, scale);
    return x + side + (4 + 14) * scale + text_width(words) * scale;
}

struct Bar {
    int x, y, width, height;
};

void draw_bar(Canvas& figure, const Bar& bar) {
    for (int column = 0; column < bar.width; ++column) {
        const float value = static_cast<float>(column) / static_cast<float>(std::max(1, bar.width - 1));
        figure.fill(bar.x + column, bar.y, 1, bar.height, heat_color(value));
    }
}

void draw_ticks(Canvas& figure, const Bar& bar, const HeatScale& scale, int text) {
    const int widest = text_width("00,000") * text;
    for (const double tick : tick_values(scale.top, std::clamp(bar.width / (2 * widest), 1, 10))) {
        const int x = bar.x + static_cast<int>(std::lround(tick / scale.top * (bar.width - text)));
        const std::string words = short_number(tick);
        figure.fill(x, bar.y + bar.height, text, 3 * text, kInk);
        const int left = x - text_width(words) * text / 2;
        figure.text(std::max(bar.x, left), bar.y + bar.height + 5 * text, words, kInk, text);
    }
}

// Title and sky key above the bar; ticks below it; at the right what lies above the top.
void draw_heat_legend(Canvas& figure, const Layout& layout, const HeatScale& scale) {
    const int text = layout.text, margin = 8 * text;
    const int title_y = layout.legend_y() + 8 * text;
    const std::string over = scale.largest > scale.top ? fmt::format("max {}", short_number(scale.largest)) : "";
    const int over_width = over.empty() ? 0 : (text_width(over) + 6) * text;
    const Bar bar{margin, title_y + 14 * text, std::min(layout.width, 900 * text) - 2 * margin - over_width, 10 * text};

    figure.text(margin, title_y, scale.title, kInk, text);
    const int key_x = margin + (text_width(scale.title) + 16) * text;
    draw_key(figure, key_x, title_y, text, kSky, "no surface");
    draw_bar(figure, bar);
    draw_ticks(figure, bar, scale, text);
    figure.text(bar.x + bar.width + 6 * text, bar.y + 2 * text, over, kFaint, text);
}

constexpr Rgb kListColor{48, 98, 214}, kTreeColor{150, 205, 62}, kMixedColor{250, 250, 246};

Rgb class_color(CellClass kind) {
    switch (kind) {
    case CellClass::list:
        return kListColor;
    case CellClass::tree:
        return kTreeColor;
    case CellClass::mixed:
        return kMixedColor;
    case CellClass::none:
        break;
    }
    return kSky;
}

// The class colours the picture's own lightness; half of it is kept flat, so that dark walls still show their class.
Rgb tint(Rgb picture, CellClass kind) {
    const float grey = 0.30f * static_cast<float>(picture.r) + 0.59f * static_cast<float>(picture.g) +
                       0.11f * static_cast<float>(picture.b);
    const auto dimmed = [&](std::uint8_t channel, float least) {
        return static_cast<std::uint8_t>(
            std::lround(static_cast<float>(channel) * (least + (1.0f - least) * grey / 255.0f)));
    };
    if (kind == CellClass::none) return {dimmed(kSky.r, 0.3f), dimmed(kSky.g, 0.3f), dimmed(kSky.b, 0.3f)};
    const Rgb color = class_color(kind);
    return {dimmed(color.r, 0.5f), dimmed(color.g, 0.5f), dimmed(color.b, 0.5f)};
}

std::string share_text(const StructurePanel& panel, CellClass kind) {
    const auto with_class = static_cast<std::size_t>(
        std::count_if(panel.classes.begin(), panel.classes.end(), [](CellClass c) { return c != CellClass::none; }));
    const auto of_kind = static_cast<std::size_t>(std::count(panel.classes.begin(), panel.classes.end(), kind));
    const double share = with_class == 0 ? 0.0 : 100.0 * static_cast<double>(of_kind) / static_cast<double>(with_class);
    return fmt::format("{:.1f}%", share);
}

std::string shares(const StructurePanel& panel) {
    return fmt::format("{}: list {}, tree {}, mixed {}", panel.heading, share_text(panel, CellClass::list),
                       share_text(panel, CellClass::tree), share_text(panel, CellClass::mixed));
}

} // namespace

Canvas heat_figure(const std::vector<HeatPanel>& panels, const HeatScale& scale, int width, int height) {
    const Layout layout = make_layout(width, height, panels.size(), 52);
    Canvas figure = make_figure(layout);
    for (int i = 0; i < layout.panels; ++i) {
        const HeatPanel& panel = panels[static_cast<std::size_t>(i)];
        draw_heading(figure, layout, i, panel.heading);
        figure.draw(layout.panel_x(i), layout.heading, heat_picture(panel, scale.top, width, height));
    }
    draw_heat_legend(figure, layout, scale);
    return figure;
}

Canvas structure_figure(const std::vector<StructurePanel>& panels, int width, int height) {
    const Layout layout = make_layout(width, height, panels.size(), 26);
    Canvas figure = make_figure(layout);
    for (int i = 0; i < layout.panels; ++i) {
        const StructurePanel& panel = panels[static_cast<std::size_t>(i)];
        draw_heading(figure, layout, i, shares(panel));
        Canvas picture = panel.shaded;
        for (std::size_t p = 0; p < panel.classes.size(); ++p)
            picture.pixels.at(p) = tint(picture.pixels.at(p), panel.classes[p]);
        figure.draw(layout.panel_x(i), layout.heading, picture);
    }
    const int y = layout.legend_y() + 9 * layout.text;
    int x = 8 * layout.text;
    x = draw_key(figure, x, y, layout.text, kListColor, "lists only");
    x = draw_key(figure, x, y, layout.text, kTreeColor, "trees only");
    x = draw_key(figure, x, y, layout.text, kMixedColor, "both in one tile");
    draw_key(figure, x, y, layout.text, {22, 23, 24}, "no lights");
    return figure;
}

Canvas picture_row(const std::vector<std::string>& headings, const std::vector<Canvas>& pictures) {
    const Layout layout = make_layout(pictures.at(0).width, pictures.at(0).height, pictures.size(), 0);
    Canvas figure = make_figure(layout);
    for (int i = 0; i < layout.panels; ++i) {
        draw_heading(figure, layout, i, headings.at(static_cast<std::size_t>(i)));
        figure.draw(layout.panel_x(i), layout.heading, pictures.at(static_cast<std::size_t>(i)));
    }
    return figure;
}

} // namespace manylights::lab::app
