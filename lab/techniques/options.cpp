#include "lab/techniques/options.h"

#include "lab/scene/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace manylights::lab {

namespace {

std::string key_list(const TechniqueInfo& info) {
    std::string keys;
    for (const OptionInfo& option : info.options) keys += (keys.empty() ? "" : ", ") + option.key;
    return keys.empty() ? "it has none" : "its options are " + keys;
}

std::optional<std::uint32_t> whole_number_of(std::string_view text, std::uint32_t lowest, std::uint32_t highest) {
    std::uint32_t number = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || stop != end || number < lowest || number > highest) return std::nullopt;
    return number;
}

} // namespace

OptionReader::OptionReader(const TechniqueInfo& info, const OptionValues& values)
    : technique_(info.name), values_(values) {
    for (auto value = values.begin(); value != values.end(); ++value) {
        const std::string& key = value->first;
        if (std::ranges::none_of(info.options, [&](const OptionInfo& option) { return option.key == key; }))
            throw InputError(fmt::format("{}: unknown option '{}'; {}", info.name, key, key_list(info)));
        if (std::any_of(values.begin(), value, [&](const auto& earlier) { return earlier.first == key; }))
            throw InputError(fmt::format("{}: option '{}' is given twice", info.name, key));
    }
}

const std::string* OptionReader::find(const std::string& key) const {
    for (const auto& [name, value] : values_)
        if (name == key) return &value;
    return nullptr;
}

void OptionReader::refuse(const std::string& key, const std::string& value, const std::string& rule) const {
    throw InputError(fmt::format("{}: option {}={}: must be {}", technique_, key, value, rule));
}

std::uint32_t OptionReader::whole_number(const std::string& key, std::uint32_t fallback, std::uint32_t lowest,
                                         std::uint32_t highest) const {
    const std::string* text = find(key);
    if (!text) return fallback;
    const std::optional<std::uint32_t> number = whole_number_of(*text, lowest, highest);
    if (!number) refuse(key, *text, fmt::format("a whole number from {} to {}", lowest, highest));
    return *number;
}

std::array<std::uint32_t, 2> OptionReader::counts(const std::string& key, const std::array<std::uint32_t, 2>& fallback,
                                                  std::uint32_t highest) const {
    const std::string* text = find(key);
    if (!text) return fallback;
    const std::size_t cross = std::min(text->find('x'), text->size());
    const std::string_view all = *text;
    const auto across = whole_number_of(all.substr(0, cross), 1, highest);
    const auto down = whole_number_of(all.substr(std::min(cross + 1, all.size())), 1, highest);
    if (!across || !down)
        refuse(key, *text, fmt::format("two whole numbers from 1 to {} with an x between them", highest));
    return {*across, *down};
}

std::optional<float> OptionReader::positive_number(const std::string& key) const {
    const std::string* text = find(key);
    if (!text) return std::nullopt;
    float number = 0;
    const char* end = text->data() + text->size();
    const auto [stop, error] = std::from_chars(text->data(), end, number);
    if (error != std::errc() || stop != end || !std::isfinite(number) || !(number > 0))
        refuse(key, *text, "a finite number above 0");
    return number;
}

std::size_t OptionReader::choice(const std::string& key, std::span<const char* const> choices) const {
    const std::string* text = find(key);
    if (!text) return 0;
    std::string allowed;
    for (std::size_t i = 0; i < choices.size(); ++i) {
        if (*text == choices[i]) return i;
        allowed += fmt::format("{}{}", i == 0 ? "" : ", ", choices[i]);
    }
    refuse(key, *text, "one of " + allowed);
}

} // namespace manylights::lab
