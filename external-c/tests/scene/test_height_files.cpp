// Files of heights, and where geometry files may lie: what is read, and what is said of the rest.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <system_error>

#include "mesh/core/mesh_data.hpp"
#include "scene/geometry_files.hpp"
#include "support/scratch_folder.hpp"

namespace test_height_files {
namespace {

using cmb::GeometryFiles;
using cmb::mesh::MeshError;

class HeightFiles : public testing::Test {
 protected:
  std::string path(const std::string &name) const { return folder_.path(name); }
  void write(const std::string &contents) const { folder_.write("z.txt", contents); }
  // A folder whose name begins with this one's.
  std::string beside() const { return folder_.path() + "-beside"; }
  // What is said of a file in a folder; empty where it is read.
  static std::string complaint(const std::string &folder, const std::string &name) {
    try {
      GeometryFiles(folder).table(name);
    } catch (const MeshError &error) {
      return error.what();
    }
    return "";
  }
  void refuses(const std::string &contents, const std::string &part) const {
    write(contents);
    const std::string said = complaint(folder_.path(), "z.txt");
    EXPECT_NE(said.find(part), std::string::npos) << '"' << contents << "\" says: " << said;
    EXPECT_NE(said.find("z.txt"), std::string::npos) << said;
    EXPECT_NE(said.find(';'), std::string::npos) << "no remedy: " << said;
  }

 private:
  cmb::test::ScratchFolder folder_{"cmb_height_files"};
};

TEST_F(HeightFiles, SeparatorsSignsCommentsAndEndsOfLineDoNotMatter) {
  for (const char *contents : {
           "1 -2.5 3e2\n0 0.25 4\n",
           "1,-2.5,3e2\n0,0.25,4",
           "+1;-2.5;+300\r\n0;0.25;4\r\n",
           "\t1\t-2.5\t300\n\n\n 0 , 0.25 , 4 \n \n",
           "# x\n1 -2.5 3E+2\n#\n# 9 9\n0 .25 4.\n#",
       }) {
    write(contents);
    GeometryFiles files(path(""));
    const GeometryFiles::Table &table = files.table("z.txt");
    EXPECT_EQ(table.columns, 3u) << contents;
    EXPECT_EQ(table.rows, 2u) << contents;
    EXPECT_EQ(table.values, (std::vector<double>{1, -2.5, 300, 0, 0.25, 4})) << contents;
    EXPECT_EQ(&table, &files.table("./z.txt")) << "read twice";
  }
}

TEST_F(HeightFiles, WhatIsNoTableOfFiniteNumbersIsRefusedWithItsLine) {
  refuses("", "no heights");
  refuses("\n \n# 1 2\n", "no heights");
  refuses("1 2\n3\n", "line 2: 1 heights where the rows before have 2");
  refuses("1 2\n\n3 4 5\n", "line 3: 3 heights where the rows before have 2");
  for (const char *number : {"nan", "inf", "-inf", "1e999", "1.5x", "--1", "+-1", "+", "0x10", "1,5e"}) {
    refuses(std::string("1 2\n3 ") + number + "\n", "line 2: number ");
    refuses(std::string("1 2\n3 ") + number + "\n", "is not a finite number");
  }
}

TEST_F(HeightFiles, FoldersAndNamesThatAreNoneAreRefused) {
  write("1 2\n3 4\n");
  EXPECT_EQ(complaint(path(""), "z.txt"), "");
  EXPECT_EQ(complaint(path(""), path("z.txt")), "");
  EXPECT_NE(complaint(path("none"), "z.txt").find("cannot be read; check the folder's name"), std::string::npos);
  EXPECT_NE(complaint("", "z.txt").find("no folder is given"), std::string::npos);
  EXPECT_NE(complaint(path(""), "").find("the name is empty"), std::string::npos);
  EXPECT_NE(complaint(path(""), ".").find("lies outside"), std::string::npos) << "the folder is no file in itself";
  EXPECT_NE(complaint(path(""), "..").find("lies outside"), std::string::npos);
  EXPECT_NE(complaint(path(""), beside() + "/z.txt").find("lies outside"), std::string::npos);
  EXPECT_NE(complaint(path(""), std::string(5000, 'a')), "");
  EXPECT_NE(complaint(path(""), "none.txt").find("no such file"), std::string::npos);
}

// The kernel says of its files that they hold a page, of which there are a few characters.
TEST(HeightFile, ThatEndsBeforeItsSizeIsRefused) {
  const std::string folder = "/sys/devices/system/cpu", name = "online";
  std::error_code error;
  if (std::filesystem::file_size(folder + "/" + name, error) < 64 || error) GTEST_SKIP() << "no " << folder << "/" << name;
  try {
    GeometryFiles(folder).table(name);
    FAIL() << "accepted";
  } catch (const MeshError &refusal) {
    EXPECT_NE(std::string(refusal.what()).find("online: cannot be read; check its permissions"), std::string::npos)
        << refusal.what();
  }
}

}  // namespace
}  // namespace test_height_files
