#include "lab/app/text_table.h"

#include <gtest/gtest.h>

namespace manylights::lab::app {
namespace {

TEST(TextTable, columns_are_aligned_and_lines_end_without_blanks) {
    TextTable table({{"name", Align::left}, {"ms", Align::right}, {"verdict", Align::left}});
    table.add({"clustered", "3", "exact"});
    table.add({"a", "12.5"});
    EXPECT_EQ(table.str(), "name         ms  verdict\n"
                           "clustered     3  exact\n"
                           "a          12.5\n");
    EXPECT_EQ(table.str(false), "clustered     3  exact\n"
                                "a          12.5\n");
}

} // namespace
} // namespace manylights::lab::app
