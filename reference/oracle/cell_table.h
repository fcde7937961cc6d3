#pragma once
// Cells of an unbounded grid, numbered in the order in which they were first used: a hash table with open addressing.

#include <cstdint>
#include <vector>

namespace manylights::oracle {

struct CellPosition {
    std::int32_t x, y, z;

    bool operator==(const CellPosition&) const = default;
};

class CellTable {
  public:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

    CellTable();

    std::uint32_t cell_count() const { return cell_count_; }
    /// The cell's number; kNone where it was never used.
    std::uint32_t find(CellPosition position) const { return slots_[slot_of(position)].cell; }
    std::uint32_t find_or_add(CellPosition position);

  private:
    struct Slot {
        CellPosition position;
        std::uint32_t cell; ///< kNone: free
    };

    std::size_t slot_of(CellPosition position) const;
    void grow();

    std::vector<Slot> slots_; ///< a power of two of them, at most half in use
    std::uint32_t cell_count_ = 0;
};

} // namespace manylights::oracle
