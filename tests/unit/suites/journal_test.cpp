// The journal: what was measured is found again, whatever moment the run was stopped at.

#include "lab/scene/error.h"
#include "lab/suites/journal.h"
#include "tests/unit/suites/sample_rows.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace manylights::lab::suites {
namespace {

const Row kHeader = {{"suite", "quality"}, {"device", "card"}};

class JournalTest : public testing::Test {
  protected:
    void SetUp() override {
        path_ =
            testing::TempDir() + "manylights_journal_" + testing::UnitTest::GetInstance()->current_test_info()->name();
        std::filesystem::remove(path_);
    }
    void TearDown() override { std::filesystem::remove(path_); }

    std::string text() const {
        std::ostringstream whole;
        whole << std::ifstream(path_, std::ios::binary).rdbuf();
        return whole.str();
    }
    void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }
    std::string refusal(const Row& header = kHeader) const {
        try {
            Journal(path_, header, schema(), true);
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    }

    std::string path_;
};

TEST_F(JournalTest, gives_back_what_was_added_when_it_is_resumed) {
    const StepResult result{{sample_row("clustered"), sample_row("exact")}, {"clustered: lost a light"}};
    Journal(path_, kHeader, schema(), false).add("a", result);
    Journal resumed(path_, kHeader, schema(), true);
    ASSERT_NE(resumed.find("a"), nullptr);
    EXPECT_EQ(resumed.find("a")->rows, result.rows);
    EXPECT_EQ(resumed.find("a")->failures, result.failures);
    EXPECT_EQ(resumed.find("b"), nullptr);
    resumed.add("b", {});
    EXPECT_NE(Journal(path_, kHeader, schema(), true).find("b"), nullptr);
}

TEST_F(JournalTest, starts_anew_without_resume_and_where_there_is_no_file) {
    Journal(path_, kHeader, schema(), true).add("a", {});
    EXPECT_EQ(Journal(path_, kHeader, schema(), false).find("a"), nullptr);
    EXPECT_EQ(Journal(path_, kHeader, schema(), true).find("a"), nullptr);
}

// Stopped after any byte: the complete lines count, and the file goes on behind them.
TEST_F(JournalTest, a_line_that_was_being_written_is_dropped) {
    Journal journal(path_, kHeader, schema(), false);
    journal.add("a", {{sample_row()}, {}});
    const std::string first = text();
    journal.add("b", {{sample_row()}, {}});
    const std::string both = text();
    for (std::size_t length = first.size(); length < both.size(); length += 97) {
        write(both.substr(0, length));
        Journal resumed(path_, kHeader, schema(), true);
        EXPECT_NE(resumed.find("a"), nullptr);
        EXPECT_EQ(resumed.find("b"), nullptr);
        resumed.add("b", {{sample_row()}, {}});
        EXPECT_EQ(text(), both);
    }
}

TEST_F(JournalTest, rows_of_another_device_are_not_mixed_in) {
    Journal(path_, kHeader, schema(), false).add("a", {});
    EXPECT_EQ(refusal({{"suite", "quality"}, {"device", "other"}}),
              "--resume '" + path_ + "': device is \"card\", must be \"other\": rows of different runs are not mixed");
}

TEST_F(JournalTest, damage_is_refused_by_line_and_rule) {
    const std::string head = kHeader.dump() + "\n";
    for (const char* line :
         {"{\"case\": 1}", "not json", "[]", R"({"case": "a", "rows": 1, "failures": []})",
          R"({"case": "a", "rows": [], "failures": [1]})", R"({"case": "a", "rows": [{}], "failures": []})"}) {
        write(head + line + "\n");
        EXPECT_NE(refusal().find("line 2: "), std::string::npos) << line << ": " << refusal();
    }
    for (const char* header : {"", "x\n", "[]\n"}) {
        write(header);
        EXPECT_NE(refusal(), "accepted") << header;
    }
}

TEST_F(JournalTest, a_file_that_cannot_be_written_is_refused_by_name) {
    EXPECT_THROW(Journal("/no/such/folder/a", kHeader, schema(), false), InputError);
}

} // namespace
} // namespace manylights::lab::suites
