// A folder of a test's own, gone with it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace cmb::test {

class ScratchFolder {
 public:
  // `purpose`: what the folder's name begins with, no other program's.
  explicit ScratchFolder(const std::string &purpose)
      : folder_(std::filesystem::temp_directory_path() /
                (purpose + "_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) + "_" +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
  }
  ~ScratchFolder() { std::filesystem::remove_all(folder_); }
  ScratchFolder(const ScratchFolder &) = delete;
  ScratchFolder &operator=(const ScratchFolder &) = delete;

  std::string path(const std::string &name = "") const { return (name.empty() ? folder_ : folder_ / name).string(); }
  void write(const std::string &name, const std::string &contents) const {
    std::ofstream(folder_ / name, std::ios::binary) << contents;
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace cmb::test
