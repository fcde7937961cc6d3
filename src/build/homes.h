#pragma once
// Lists that grow side by side: the records of tiles, the lights of cells. Each has a home: as much room as it had use
// for the last time, and an eighth more. Behind all homes are chunks for what does not fit; a list has its own in a
// chain. A home begins where the one before ends, so that reading all lists reads on through memory, unless what they
// hold has changed much since.
//
//   items  | home of list 0 | home of list 1 | ... | home of the last | chunk 0 | chunk 1 | ... | for too many |
//                                          homes[list count] = chunks ^

#include "src/build/array.h"

#include <cstdint>

namespace manylights::detail {

struct HomeCursor {
    std::uint32_t next, limit; // where the next item goes, and where its room ends
};

template <typename Item, typename Cursor, std::uint32_t kItems>
struct HomePool {
    static constexpr std::uint32_t kChunk = kItems;

    Item* items;
    Cursor* cursors;        // per list
    std::uint32_t* homes;   // per list, and one behind: where its home begins
    std::uint32_t* firsts;  // per list: its first chunk, if it has one
    std::uint32_t* next;    // per chunk: the list's next one
    std::uint32_t chunks;   // where they begin
    std::uint32_t capacity; // of chunks; one more takes what is too much
    std::uint32_t used;     // also where that is more than there are: then what the lists hold is worth nothing
};

// Keeps the lengths of the last time; of other lists, or as many others, nothing is known. False: out of memory.
[[nodiscard]] inline bool keep_lengths(Array<std::uint32_t>& lengths, std::size_t size) {
    if (lengths.size() == size) return true;
    if (!lengths.resize(size)) return false;
    lengths.fill_zero();
    return true;
}

// Homes for lists of these lengths, as far as that much room suffices. Chunks begin behind them.
template <typename Item, typename Cursor, std::uint32_t kChunk>
void assign_homes(HomePool<Item, Cursor, kChunk>& pool, const std::uint32_t* lengths, std::uint64_t list_count,
                  std::uint64_t room) {
    std::uint32_t at = 0;
    for (std::uint64_t i = 0; i < list_count; ++i) {
        const std::uint64_t expected = lengths[i] + lengths[i] / std::uint64_t{8};
        const std::uint64_t end = at + (expected + (kChunk - 1)) / kChunk * kChunk;
        Cursor cursor{};
        pool.homes[i] = cursor.next = at;
        if (end <= room) at = static_cast<std::uint32_t>(end);
        cursor.limit = at;
        pool.cursors[i] = cursor;
    }
    pool.homes[list_count] = pool.chunks = at;
    pool.used = 0;
}

// Where the next item of a list whose room is full goes: into a new chunk.
template <typename Item, typename Cursor, std::uint32_t kChunk>
std::uint32_t open_chunk(HomePool<Item, Cursor, kChunk>& pool, std::uint32_t list, Cursor& cursor) {
    const std::uint32_t chunk = pool.used < pool.capacity ? pool.used : pool.capacity;
    ++pool.used;
    if (cursor.limit == pool.homes[list + 1])
        pool.firsts[list] = chunk;
    else
        pool.next[(cursor.limit - pool.chunks) / kChunk - 1] = chunk;
    const std::uint32_t begin = pool.chunks + chunk * kChunk;
    cursor.limit = begin + kChunk;
    return begin;
}

// What a list holds at home: where, and how many.
template <typename Item>
struct HomeItems {
    const Item* items;
    std::uint32_t count;
    bool is_all; // nothing of it is in chunks
};
template <typename Item, typename Cursor, std::uint32_t kChunk>
HomeItems<Item> items_at_home(const HomePool<Item, Cursor, kChunk>& pool, std::uint64_t list) {
    const Cursor& cursor = pool.cursors[list];
    const std::uint32_t home = pool.homes[list];
    const std::uint32_t home_end = pool.homes[list + 1];
    const bool is_all = cursor.limit == home_end;
    return {pool.items + home, (is_all ? cursor.next : home_end) - home, is_all};
}

// Calls visit(items, count) for what a list that has chunks holds in these, in order.
template <typename Item, typename Cursor, std::uint32_t kChunk, typename Visit>
void visit_chunks(const HomePool<Item, Cursor, kChunk>& pool, std::uint64_t list, const Visit& visit) {
    const Cursor& cursor = pool.cursors[list];
    for (std::uint32_t chunk = pool.firsts[list];; chunk = pool.next[chunk]) {
        const std::uint32_t begin = pool.chunks + chunk * kChunk;
        const bool is_last = begin + kChunk == cursor.limit;
        visit(pool.items + begin, is_last ? cursor.next - begin : kChunk);
        if (is_last) return;
    }
}

// Calls visit(items, count) for all that a list holds, in order.
template <typename Item, typename Cursor, std::uint32_t kChunk, typename Visit>
void visit_list(const HomePool<Item, Cursor, kChunk>& pool, std::uint64_t list, const Visit& visit) {
    const HomeItems<Item> home = items_at_home(pool, list);
    if (home.count != 0) visit(home.items, home.count);
    if (!home.is_all) visit_chunks(pool, list, visit);
}

template <typename Item, typename Cursor, std::uint32_t kChunk>
std::uint32_t list_length(const HomePool<Item, Cursor, kChunk>& pool, std::uint64_t list) {
    const HomeItems<Item> home = items_at_home(pool, list);
    std::uint32_t length = home.count;
    if (!home.is_all) visit_chunks(pool, list, [&](const Item*, std::uint32_t count) { length += count; });
    return length;
}

} // namespace manylights::detail
