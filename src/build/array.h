#pragma once
// Memory of a builder: the caller's callbacks, and arrays that only grow. Once a builder has seen a frame of a size,
// frames of that size allocate nothing.

#include "manylights/manylights.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace manylights::detail {

struct Allocator {
    ManylightsAllocate allocate;
    ManylightsRelease release;
    void* user;
};

// An array of plain data. resize() keeps the elements up to the smaller of both sizes and leaves new ones unset.
template <typename T>
class Array {
  public:
    static_assert(std::is_trivially_copyable_v<T>);

    Array() = default;
    Array(const Array&) = delete;
    Array& operator=(const Array&) = delete;
    ~Array() { reset(); }

    void use(const Allocator& allocator) { allocator_ = &allocator; }

    [[nodiscard]] bool resize(std::size_t size) {
        if (size > capacity_ && !grow(size)) return false;
        size_ = size;
        return true;
    }

    [[nodiscard]] bool push(const T& value) {
        if (size_ == capacity_ && !grow(size_ + 1)) return false;
        data_[size_++] = value;
        return true;
    }

    void clear() { size_ = 0; }
    void fill_zero() {
        if (size_ != 0) std::memset(static_cast<void*>(data_), 0, size_ * sizeof(T));
    }

    std::size_t size() const { return size_; }
    T* data() { return data_; }
    const T* data() const { return data_; }
    T& operator[](std::size_t i) { return data_[i]; }
    const T& operator[](std::size_t i) const { return data_[i]; }

    void reset() {
        if (data_ != nullptr) allocator_->release(allocator_->user, data_, capacity_ * sizeof(T));
        data_ = nullptr;
        size_ = 0;
        capacity_ = 0;
    }

  private:
    // Half as much again, so that pushing n elements copies O(n).
    bool grow(std::size_t least) {
        constexpr std::size_t kMost = SIZE_MAX / sizeof(T) / 2;
        if (least > kMost) return false;
        const std::size_t wanted = capacity_ + capacity_ / 2 + 16;
        const std::size_t capacity = wanted > least ? wanted : least;
        constexpr std::size_t kAlignment = alignof(T) > 16 ? alignof(T) : 16;
        void* memory = allocator_->allocate(allocator_->user, capacity * sizeof(T), kAlignment);
        if (memory == nullptr) return false;
        if (size_ != 0) std::memcpy(memory, static_cast<const void*>(data_), size_ * sizeof(T));
        if (data_ != nullptr) allocator_->release(allocator_->user, data_, capacity_ * sizeof(T));
        data_ = static_cast<T*>(memory);
        capacity_ = capacity;
        return true;
    }

    const Allocator* allocator_ = nullptr;
    T* data_ = nullptr;
    std::size_t size_ = 0;
    std::size_t capacity_ = 0;
};

} // namespace manylights::detail
