#pragma once
// Hash of exact float values, to pin what must be the same on every machine.

#include <bit>
#include <cstdint>
#include <initializer_list>

namespace manylights::lab {

class FloatHash {
  public:
    void add(std::uint32_t word) { value_ = (value_ ^ word) * 1099511628211ull; }
    void add(std::initializer_list<float> values) {
        for (const float value : values) add(std::bit_cast<std::uint32_t>(value));
    }
    std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 14695981039346656037ull; // FNV-1a over words
};

} // namespace manylights::lab
