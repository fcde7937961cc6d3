#pragma once
// Reads the values of options as they were typed. Every refusal is one line: the option, what was given, the rule.

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace manylights::lab::app {

constexpr std::uint32_t kMostLights = 1u << 24;
constexpr std::uint32_t kLargestSide = 8192; ///< of an image, pixels

/// Throws InputError: OPTION 'VALUE': must be RULE.
[[noreturn]] void refuse(const std::string& option, const std::string& value, const std::string& rule);

std::uint32_t whole_number(const std::string& option, const std::string& text, std::uint32_t least, std::uint32_t most);
/// Finite and above zero.
double positive_number(const std::string& option, const std::string& text);
/// The index of the text among the choices.
std::size_t choice(const std::string& option, const std::string& text, std::span<const char* const> choices);

struct ImageSize {
    std::uint32_t width, height;
};
/// WIDTHxHEIGHT, each from 1 to kLargestSide.
ImageSize image_size(const std::string& option, const std::string& text);

} // namespace manylights::lab::app
