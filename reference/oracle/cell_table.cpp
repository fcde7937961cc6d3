#include "reference/oracle/cell_table.h"

namespace manylights::oracle {

namespace {

std::uint64_t hash(CellPosition position) {
    const auto word = [](std::int32_t coordinate) { return std::uint64_t{static_cast<std::uint32_t>(coordinate)}; };
    std::uint64_t h = word(position.x) * 0x9E3779B97F4A7C15u;
    h = (h ^ word(position.y)) * 0xD1342543DE82EF95u;
    h = (h ^ word(position.z)) * 0xBF58476D1CE4E5B9u;
    return h ^ (h >> 32u);
}

} // namespace

CellTable::CellTable() : slots_(16, Slot{{0, 0, 0}, kNone}) {}

// The slot that holds the position, or the free one where it belongs. There is always a free one.
std::size_t CellTable::slot_of(CellPosition position) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = static_cast<std::size_t>(hash(position)) & mask;
    while (slots_[slot].cell != kNone && !(slots_[slot].position == position)) slot = (slot + 1) & mask;
    return slot;
}

std::uint32_t CellTable::find_or_add(CellPosition position) {
    std::size_t slot = slot_of(position);
    if (slots_[slot].cell != kNone) return slots_[slot].cell;
    if (2 * (std::size_t{cell_count_} + 1) > slots_.size()) {
        grow();
        slot = slot_of(position);
    }
    slots_[slot] = {position, cell_count_};
    return cell_count_++;
}

void CellTable::grow() {
    std::vector<Slot> old(2 * slots_.size(), Slot{{0, 0, 0}, kNone});
    old.swap(slots_);
    for (const Slot& slot : old)
        if (slot.cell != kNone) slots_[slot_of(slot.position)] = slot;
}

} // namespace manylights::oracle
