// The journal of a study: what survives, what is refused.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/content_hash.hpp"
#include "floatframe/sweep/sweep_journal.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

SweepRow row(const std::string& value) {
  return {"completed", "", {{"tip.x final [m]", value}, {"a \"b\", c", "-0"}}};
}

class Journal : public testing::Test {
 protected:
  std::string text() const { return folder_.read("sweep.journal"); }
  void set_text(const std::string& t) const { folder_.write("sweep.journal", t); }
  std::size_t finished(const SweepIdentity& identity = study) const {
    return SweepJournal(path_, identity, 10, false).finished().size();
  }
  std::string refusal(const SweepIdentity& identity, std::size_t runs = 10) const {
    return test::error_of([&] { SweepJournal(path_, identity, runs, false); });
  }

  test::TemporaryFolder folder_;
  const std::string path_ = folder_.file("sweep.journal");
  inline static const SweepIdentity study{{"another program", "1"}, {"another model", "abc"}};
};

TEST_F(Journal, RowsComeBackAsTheyWere) {
  {
    SweepJournal journal(path_, study, 10, false);
    journal.add(encode_row(7, row("0.10000000000000001")));
    journal.add(encode_row(0, {"failed", "joint 'a':\nno, \"way\"", {}}));
  }
  const SweepJournal journal(path_, study, 10, false);
  ASSERT_EQ(journal.finished().size(), 2u);
  EXPECT_EQ(journal.finished().at(7).fields, row("0.10000000000000001").fields);
  EXPECT_EQ(journal.finished().at(0).status, "failed");
  EXPECT_EQ(journal.finished().at(0).message, "joint 'a':\nno, \"way\"");
}

// Cut anywhere, the journal opens and holds exactly the rows whose lines are whole; a row added
// after that is not spoilt by the rest of the torn line.
TEST_F(Journal, CutAnywhereItKeepsTheWholeLines) {
  {
    SweepJournal journal(path_, study, 10, false);
    for (std::size_t run = 0; run < 3; ++run) journal.add(encode_row(run, row("1")));
  }
  const std::string whole = text();
  for (std::size_t cut = 0; cut <= whole.size(); cut += 7) {
    set_text(whole.substr(0, cut));
    const auto lines = std::count(whole.begin(), whole.begin() + static_cast<long>(cut), '\n');
    const std::size_t expected = lines > 1 ? static_cast<std::size_t>(lines - 1) : 0;
    ASSERT_EQ(finished(), expected) << cut;
    SweepJournal(path_, study, 10, false).add(encode_row(9, row("2")));
    ASSERT_EQ(finished(), expected + 1) << cut;
  }
}

TEST_F(Journal, DamagedLinesAreLeftOut) {
  {
    SweepJournal journal(path_, study, 10, false);
    for (std::size_t run = 0; run < 3; ++run) journal.add(encode_row(run, row("1")));
  }
  std::string damaged = text();
  const std::size_t at = damaged.find("\"run\":2");
  damaged[at + 6] = '5';  // a line that would be read as another run
  set_text(damaged);
  const SweepJournal journal(path_, study, 10, false);
  EXPECT_EQ(journal.finished().size(), 2u);
  EXPECT_FALSE(journal.finished().contains(1));
  EXPECT_FALSE(journal.finished().contains(4));
}

TEST_F(Journal, AnotherStudyIsRefusedWithTheReason) {
  SweepJournal(path_, study, 10, false).add(encode_row(0, row("1")));
  const std::string before = text();
  EXPECT_EQ(refusal({{"another program", "2"}, {"another model", "xyz"}}), "mismatch");
  EXPECT_EQ(refusal({{"another program", "1"}, {"another model", "xyz"}}), "mismatch");
  EXPECT_EQ(refusal(study, 11), "mismatch");
  EXPECT_EQ(text(), before);
  EXPECT_EQ(SweepJournal(path_, {{"another program", "2"}}, 10, true).finished().size(), 0u);
  EXPECT_EQ(finished({{"another program", "2"}}), 0u);
}

TEST_F(Journal, ForeignFilesStayUntouched) {
  set_text("time [s],x\n0,1\n");
  EXPECT_EQ(refusal(study), "mismatch");
  EXPECT_EQ(text(), "time [s],x\n0,1\n");
  set_text("a long line without an end, not ours");
  EXPECT_EQ(refusal(study), "mismatch");
}

TEST_F(Journal, ARepeatedRunCountsByItsLastLine) {
  {
    SweepJournal journal(path_, study, 10, false);
    journal.add(encode_row(1, failed_row("crashed")));
    journal.add(encode_row(2, row("1")));
  }
  {
    SweepJournal journal(path_, study, 10, false);
    journal.forget_failed();
    EXPECT_EQ(journal.finished().size(), 1u);
    EXPECT_TRUE(journal.finished().contains(2));
  }
  EXPECT_EQ(finished(), 2u);  // nothing is lost before the run is repeated
  {
    SweepJournal journal(path_, study, 10, false);
    journal.forget_failed();
    journal.add(encode_row(1, row("2")));
  }
  const SweepJournal journal(path_, study, 10, false);
  EXPECT_EQ(journal.finished().at(1).status, "completed");
}

// A run whose reading was stopped has files that are not known before it is repeated.
TEST_F(Journal, FilesMustNotChangeButMayComeToBeKnown) {
  const auto open = [&](const SweepJournal::Files& files) {
    const std::string what = test::sentences_of(
        [&] { SweepJournal(path_, study, 10, false, files).add(encode_row(0, row("1"))); });
    const std::size_t begin = what.find('(');
    return begin == std::string::npos ? what : what.substr(begin, what.find(')') + 1 - begin);
  };
  EXPECT_EQ(open({{"a", "1"}}), "no error");
  EXPECT_EQ(open({{"a", "2"}}), "(the file 'a' has changed)");
  EXPECT_EQ(open({{"a", "1"}, {"b", "1"}}), "no error");
  EXPECT_EQ(open({{"a", "1"}}), "no error");
  EXPECT_EQ(open({{"a", "1"}, {"b", "2"}}), "(the file 'b' has changed)");
  EXPECT_EQ(finished(), 1u);
}

// Anything may lie at the place of the journal; it is neither waited for nor read without end.
TEST_F(Journal, OnlyRegularFilesAreAccepted) {
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  EXPECT_EQ(refusal(study), "unreadable");
  std::filesystem::remove(path_);
  std::filesystem::create_symlink("/dev/zero", path_);
  EXPECT_EQ(refusal(study), "unreadable");
  std::filesystem::remove(path_);
  std::filesystem::create_directory(path_);
  EXPECT_THROW(SweepJournal(path_, study, 10, false), OutputError);
}

// Lines with a right fingerprint and the wrong content.
TEST_F(Journal, LinesOfAnotherShapeAreNoStudyAndNoRows) {
  const auto line = [](const std::string& json) {
    return content_hash(json).substr(0, 16) + ' ' + json + '\n';
  };
  const std::string difference = "mismatch";
  for (const std::string identity : {"3", "\"x\"", "{}", "[]", "[1]", "null"}) {
    set_text(line("{\"floatframe_sweep\":1,\"runs\":10,\"identity\":" + identity + "}"));
    EXPECT_EQ(refusal(study), difference) << identity;
  }
  set_text(line("{\"floatframe_sweep\":1}"));
  EXPECT_EQ(refusal(study), difference);
  SweepJournal(path_, study, 10, true).add(encode_row(0, row("1")));
  const std::string good = text();
  for (const std::string json :
       {"{\"run\":-1,\"status\":\"completed\",\"message\":\"\",\"fields\":[]}",
        "{\"run\":1.5,\"status\":\"completed\",\"message\":\"\",\"fields\":[]}",
        "{\"run\":11,\"status\":\"completed\",\"message\":\"\",\"fields\":[]}",
        "{\"run\":3,\"status\":1,\"message\":\"\",\"fields\":[]}",
        "{\"run\":3,\"status\":\"completed\",\"message\":\"\",\"fields\":[[1]]}", "[]", "3",
        "{\"files\":3}", "{\"files\":{\"a\":3}}"})
    set_text(text() + line(json));
  set_text(text() + line(std::string(100000, '[')) + '\0' + "\n\n");
  EXPECT_EQ(finished(), 1u);
}

TEST_F(Journal, OneProcessAtATime) {
  const SweepJournal first(path_, study, 10, false);
  EXPECT_EQ(refusal(study), "in_use");
}

TEST(ContentHash, IsFnv1a128) {
  // Reference: FNV-1a 128 of the length (8 bytes, little endian) followed by the bytes.
  EXPECT_EQ(ContentHash().text(), "6c62272e07bb014262b821756295c58d");
  EXPECT_NE(content_hash("ab"), content_hash("ba"));
  EXPECT_NE(ContentHash().add("ab").add("c").text(), ContentHash().add("a").add("bc").text());
}

}  // namespace
}  // namespace floatframe
