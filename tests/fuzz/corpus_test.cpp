// The inputs of the fuzz targets, each read once: what was found stays mended.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/fuzz/targets.h"

namespace pintle::corpus_test {
namespace {

namespace fs = std::filesystem;

void replay(const char* name, void (*target)(std::string_view)) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(PINTLE_SOURCE_DIR) / "tests/fuzz/corpus" / name)) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    SCOPED_TRACE(entry.path().filename().string());
    EXPECT_NO_THROW(target(bytes));
    ++count;
  }
  EXPECT_GT(count, 3) << "the corpus is not where this looks for it";
}

TEST(Corpus, OfScenesIsReadOrRefused) { replay("scene", fuzz_scene); }
TEST(Corpus, OfStudiesIsReadOrRefused) { replay("study", fuzz_study); }
TEST(Corpus, OfTablesIsReadOrRefused) { replay("table", fuzz_table); }
TEST(Corpus, OfInputFilesIsReadOrRefused) { replay("inp", fuzz_inp); }
TEST(Corpus, OfTheMeshersAnswersIsReadOrRefused) { replay("wire", fuzz_wire); }
TEST(Corpus, OfMeshesIsReadOrRefused) { replay("msh", fuzz_msh); }
TEST(Corpus, OfSavedStatesIsReadOrRefused) { replay("state", fuzz_state); }
TEST(Corpus, OfSweepJournalsIsReadOrRefused) { replay("journal", fuzz_journal); }

}  // namespace
}  // namespace pintle::corpus_test
