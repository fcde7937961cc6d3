#pragma once
// Memory that only grows and is never cleared: what a frame writes, it writes in full.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <type_traits>

namespace manylights::paper {

template <class T>
class FlatArray {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    /// Room for count elements, the first `kept` of them as they were.
    T* require(std::size_t count, std::size_t kept = 0) {
        if (count > capacity_) {
            const std::size_t capacity = std::max(count, capacity_ + capacity_ / 2);
            auto grown = std::make_unique_for_overwrite<T[]>(capacity);
            std::copy_n(data_.get(), kept, grown.get());
            data_ = std::move(grown);
            capacity_ = capacity;
        }
        return data_.get();
    }

    T* data() { return data_.get(); }
    const T* data() const { return data_.get(); }

  private:
    std::unique_ptr<T[]> data_;
    std::size_t capacity_ = 0;
};

} // namespace manylights::paper
