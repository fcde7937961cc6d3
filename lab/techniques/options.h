#pragma once
// Reads a technique's options, KEY=VALUE pairs, and refuses what does not fit: each refusal names the key, the value
// and what is allowed.

#include "lab/techniques/technique.h"

#include <array>
#include <optional>

namespace manylights::lab {

class OptionReader {
  public:
    /// Throws InputError when a key is not one of info.options, or is given twice.
    OptionReader(const TechniqueInfo& info, const OptionValues& values);

    bool given(const std::string& key) const { return find(key) != nullptr; }
    std::uint32_t whole_number(const std::string& key, std::uint32_t fallback, std::uint32_t lowest,
                               std::uint32_t highest) const;
    /// A finite number above zero; empty where the key is not given.
    std::optional<float> positive_number(const std::string& key) const;
    /// Two whole numbers with an x between them, each from 1 to highest; the fallback where the key is not given.
    std::array<std::uint32_t, 2> counts(const std::string& key, const std::array<std::uint32_t, 2>& fallback,
                                        std::uint32_t highest) const;
    /// The index of the value in the choices; 0 where the key is not given.
    std::size_t choice(const std::string& key, std::span<const char* const> choices) const;

  private:
    const std::string* find(const std::string& key) const;
    [[noreturn]] void refuse(const std::string& key, const std::string& value, const std::string& rule) const;

    std::string technique_;
    OptionValues values_;
};

} // namespace manylights::lab
