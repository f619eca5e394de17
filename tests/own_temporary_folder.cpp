// Each process of tests has a temporary folder of its own, which those that it starts inherit: tests run side by side, and two builds may be
// tested at once, so that no name in the machine's folder is anyone's alone.
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>

namespace {

class OwnTemporaryFolder {
 public:
  OwnTemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "pintle_tests_XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) return;  // the machine's folder has to do
    path_ = pattern;
    ::setenv("TMPDIR", pattern.c_str(), 1);
    ::setenv("TEST_TMPDIR", pattern.c_str(), 1);  // testing::TempDir()
  }
  ~OwnTemporaryFolder() {
    std::error_code ignored;
    if (::getpid() == owner_ && !path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  OwnTemporaryFolder(const OwnTemporaryFolder&) = delete;

 private:
  pid_t owner_ = ::getpid();
  std::filesystem::path path_;
};

const OwnTemporaryFolder own_temporary_folder;

}  // namespace
