#include "tessera/io/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tessera/io/file.h"

namespace tessera {
namespace {

namespace fs = std::filesystem;

class AtomicFilesTest : public ::testing::Test {
 protected:
  AtomicFilesTest() { fs::create_directory(folder_); }
  ~AtomicFilesTest() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string text(const std::string& name) const { return read_file(path(name)).value_or("(none)"); }
  std::ptrdiff_t entries() const { return std::distance(fs::directory_iterator(folder_), fs::directory_iterator()); }
  void put(const std::string& name, const std::string& bytes) const { std::ofstream(path(name)) << bytes; }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("tessera-atomic-" + std::to_string(getpid()));
};

TEST_F(AtomicFilesTest, AppearsOnCommitOnly) {
  AtomicFiles files;
  ASSERT_TRUE(files.add(path("a.svg"), "one").has_value());
  ASSERT_TRUE(files.add(path("b.svg"), "two").has_value());
  EXPECT_FALSE(fs::exists(path("a.svg")));
  ASSERT_TRUE(files.commit().has_value());
  EXPECT_EQ(text("a.svg"), "one");
  EXPECT_EQ(text("b.svg"), "two");
  EXPECT_EQ(entries(), 2);
}

TEST_F(AtomicFilesTest, LeavesNothingWithoutCommit) {
  put("old.svg", "old");
  {
    AtomicFiles files;
    ASSERT_TRUE(files.add(path("old.svg"), "new").has_value());
    ASSERT_TRUE(files.add_folder(path("plots")).has_value());
    ASSERT_TRUE(files.add(path("plots/a.svg"), "plot").has_value());
  }
  EXPECT_EQ(text("old.svg"), "old");
  EXPECT_EQ(entries(), 1);
}

TEST_F(AtomicFilesTest, KeepsModeAndLinks) {
  put("real.svg", "old");
  chmod(path("real.svg").c_str(), 0640);
  fs::create_symlink("real.svg", path("link.svg"));
  AtomicFiles files;
  ASSERT_TRUE(files.add(path("link.svg"), "new").has_value());
  ASSERT_TRUE(files.commit().has_value());
  EXPECT_TRUE(fs::is_symlink(path("link.svg")));
  EXPECT_EQ(text("real.svg"), "new");
  struct stat info {};
  stat(path("real.svg").c_str(), &info);
  EXPECT_EQ(info.st_mode & 07777, 0640u);
}

TEST_F(AtomicFilesTest, RefusesWhatCannotBeWritten) {
  put("file", "");
  AtomicFiles files;
  for (const std::string& name : {path("missing/a.svg"), path("file/a.svg"), path("."), std::string("/proc/a.svg")}) {
    auto done = files.add(name, "x");
    if (done) done = files.commit();
    ASSERT_FALSE(done.has_value()) << name;
    EXPECT_EQ(done.error().code, StatusCode::kUnwritable);
    EXPECT_EQ(done.error().field, name);
  }
  EXPECT_FALSE(files.add_folder(path("missing/plots")).has_value());
}

TEST_F(AtomicFilesTest, AFullDeviceKeepsTheOthersAway) {
  if (!fs::is_character_file("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  {
    AtomicFiles files;
    ASSERT_TRUE(files.add(path("a.svg"), "one").has_value());
    ASSERT_TRUE(files.add("/dev/full", "two").has_value());
    const auto done = files.commit();
    ASSERT_FALSE(done.has_value());
    EXPECT_EQ(done.error().field, "/dev/full");
  }
  EXPECT_EQ(entries(), 0);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(AtomicFilesTest, WhereOneCannotBePutInPlaceTheOlderOnesAreBack) {
  put("old.svg", "old");
  put("older.svg", "older");
  {
    AtomicFiles files;
    ASSERT_TRUE(files.add(path("old.svg"), "new").has_value());
    ASSERT_TRUE(files.add(path("first.svg"), "new").has_value());
    ASSERT_TRUE(files.add(path("older.svg"), "new").has_value());
    ASSERT_TRUE(files.add(path("last.svg"), "new").has_value());
    fs::create_directory(path("last.svg"));  // meanwhile, by somebody else
    const auto done = files.commit();
    ASSERT_FALSE(done.has_value());
    EXPECT_EQ(done.error().code, StatusCode::kUnwritable);
    EXPECT_EQ(done.error().field, path("last.svg"));
  }
  EXPECT_EQ(text("old.svg"), "old");
  EXPECT_EQ(text("older.svg"), "older");
  EXPECT_EQ(entries(), 3);
}

TEST_F(AtomicFilesTest, AFolderThatGoesMeanwhileIsTold) {
  fs::create_directory(path("out"));
  AtomicFiles files;
  ASSERT_TRUE(files.add(path("out/a.svg"), "new").has_value());
  fs::remove_all(path("out"));
  const auto done = files.commit();
  ASSERT_FALSE(done.has_value());
  EXPECT_EQ(done.error().field, path("out/a.svg"));
}

TEST_F(AtomicFilesTest, ReadsBackLargeFiles) {
  const std::string bytes(300'000, 'x');
  AtomicFiles files;
  ASSERT_TRUE(files.add(path("large"), bytes).has_value());
  ASSERT_TRUE(files.commit().has_value());
  EXPECT_EQ(text("large"), bytes);
}

TEST_F(AtomicFilesTest, ReadingSaysWhatIsWrong) {
  for (const std::string& name : {path("missing"), path(".")}) {
    const auto bytes = read_file(name);
    ASSERT_FALSE(bytes.has_value());
    EXPECT_EQ(bytes.error().code, StatusCode::kInvalidInput);
    EXPECT_EQ(bytes.error().field, name);
  }
}

}  // namespace
}  // namespace tessera
