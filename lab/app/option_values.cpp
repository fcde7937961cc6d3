#include "lab/app/option_values.h"

#include "lab/scene/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace manylights::lab::app {

void refuse(const std::string& option, const std::string& value, const std::string& rule) {
    throw InputError(fmt::format("{} '{}': must be {}", option, value, rule));
}

std::uint32_t whole_number(const std::string& option, const std::string& text, std::uint32_t least,
                           std::uint32_t most) {
    std::uint32_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stopped != end || value < least || value > most)
        refuse(option, text, fmt::format("a whole number from {} to {}", least, most));
    return value;
}

double positive_number(const std::string& option, const std::string& text) {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stopped != end || !std::isfinite(value) || !(value > 0.0))
        refuse(option, text, "a number above 0");
    return value;
}

std::size_t choice(const std::string& option, const std::string& text, std::span<const char* const> choices) {
    const auto found = std::find(choices.begin(), choices.end(), text);
    if (found == choices.end()) refuse(option, text, fmt::format("one of {}", fmt::join(choices, ", ")));
    return static_cast<std::size_t>(found - choices.begin());
}

ImageSize image_size(const std::string& option, const std::string& text) {
    const std::size_t cross = text.find('x');
    const std::string rule = fmt::format("WIDTHxHEIGHT, each from 1 to {}", kLargestSide);
    if (cross == std::string::npos) refuse(option, text, rule);
    try {
        return {whole_number(option, text.substr(0, cross), 1, kLargestSide),
                whole_number(option, text.substr(cross + 1), 1, kLargestSide)};
    } catch (const InputError&) {
        refuse(option, text, rule);
    }
}

} // namespace manylights::lab::app
