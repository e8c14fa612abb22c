#include "strip_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

using WorldFiles = StripScene;

/// A file in NumPy's format, version 1.
std::string npy(const std::string& header, const std::vector<double>& numbers) {
    std::string bytes = std::string("\x93NUMPY\x01\x00", 8);
    bytes += static_cast<char>(header.size());
    bytes += '\0';
    bytes += header;
    const std::size_t start = bytes.size();
    bytes.resize(start + numbers.size() * sizeof(double));
    std::memcpy(bytes.data() + start, numbers.data(), numbers.size() * sizeof(double));
    return bytes;
}

std::string npy_of(const std::string& shape, const std::vector<double>& numbers) {
    return npy("{'descr': '<f8', 'fortran_order': False, 'shape': " + shape + ", }\n", numbers);
}

/// The numbers of a file that the program wrote, after its header.
std::vector<double> numbers_of(const std::string& bytes) {
    const std::size_t start = bytes.find('\n') + 1;
    std::vector<double> numbers((bytes.size() - start) / sizeof(double));
    std::memcpy(numbers.data(), bytes.data() + start, numbers.size() * sizeof(double));
    return numbers;
}

TEST_F(WorldFiles, TablesAreReadFromCsvAndNumPy) {
    folder_.write("poses.csv",
                  "\xEF\xBB\xBF# x, \"y\", degrees\r\n\r\n2.5,1, 0\r\n 4.5,1,0\n8,3.5,0");
    folder_.write("poses.npy", npy_of("(3, 3)", {2.5, 1, 0, 4.5, 1, 0, 8, 3.5, 0}));
    folder_.write("points.csv", "1.75,1.75\n10.25,1.5\n");
    folder_.write("segments.csv", "0.5,1.25,5.5,1.25\n");
    folder_.write("sweeps.csv", "6,1,0,2,1,0\n");
    folder_.write("rectangles.csv", "0.5,0.5,2,2\n");
    const std::string poses = R"({"query": "poses", "shape": "square", "against": "placed", )";
    const std::string cast =
        R"({"query": "cast", "shape": "square", "against": "placed", "tolerance": 0.01, )";
    const Json results = results_of(
        poses + R"("poses": [[2.5, 1, 0], [4.5, 1, 0], [8, 3.5, 0]]},)" +  //
        poses + R"("poses_file": "poses.csv"},)" + poses + R"("poses_file": "poses.npy"},
        {"query": "overlap", "points": [[1.75, 1.75], [10.25, 1.5]]},
        {"query": "overlap", "points_file": "points.csv"},
        {"query": "rays", "segments": [[0.5, 1.25, 5.5, 1.25]]},
        {"query": "rays", "segments_file": "segments.csv"},
        {"query": "overlap", "rectangles": [[0.5, 0.5, 2, 2]]},
        {"query": "overlap", "rectangles_file": "rectangles.csv"},)" +     //
        cast +
        R"("sweeps": [[[6, 1, 0], [2, 1, 0]]]},)" + cast + R"("sweeps_file": "sweeps.csv"})");
    ASSERT_EQ(results.size(), 11U);
    EXPECT_EQ(results.at(0).at("records"), Json({false, true, true}));
    EXPECT_EQ(results.at(1), results.at(0));
    EXPECT_EQ(results.at(2), results.at(0));
    for (std::size_t i = 3; i < 11; i += 2) {
        EXPECT_EQ(results.at(i).at("count"), i == 3 ? 2 : 1);
        EXPECT_EQ(results.at(i + 1), results.at(i));
    }
}

TEST_F(WorldFiles, TablesOfSpreadsheetsHaveSemicolonsOrTabs) {
    folder_.write("poses.csv", "x,y,degrees\n2.5,1,0\n4.5,1,0\n8,3.5,0\n");
    folder_.write("semicolons.csv", "x;y;Grad\n2,5;1;0\n4,5; 1 ;0\n8;3.5;0,0\n");
    folder_.write("tabs.csv", "\n2,5\t1\t0\r\n4.5\t1\t0\r\n8\t3,5\t0\r\n");
    const std::string poses =
        R"({"query": "poses", "shape": "square", "against": "placed", "poses_file": )";
    const Json results = results_of(poses + R"("poses.csv"},)" + poses + R"("semicolons.csv"},)" +
                                    poses + R"("tabs.csv"})");
    EXPECT_EQ(results.at(0).at("records"), Json({false, true, true}));
    EXPECT_EQ(results.at(1), results.at(0));
    EXPECT_EQ(results.at(2), results.at(0));
}

TEST_F(WorldFiles, RecordsGoIntoCsv) {
    const Json result = results_of(
        R"({"query": "nearest", "points": [[4.5, 1.75], [90, 90]], "count": 2, "max_distance": 2.25,
            "against": "items", "values": "near.csv"},
           {"query": "poses", "shape": "square", "poses": [[7, 1, 0], [4, 1, 0]],
            "values": "hits.csv"},
           {"query": "rays", "segments": [[5.5, 3, 6.5, 3]], "values": "rays.csv"},
           {"query": "cast", "shape": "square", "against": "i3", "tolerance": 0.01,
            "sweeps": [[[7, 3, 0], [6, 3, 0]]], "values": "cast.csv"})");
    EXPECT_FALSE(result.at(0).contains("records"));
    EXPECT_EQ(result.at(0).at("values"), folder_.path("near.csv"));
    EXPECT_EQ(result.at(0).at("found"), 2);
    const std::string near = folder_.read("near.csv");
    EXPECT_TRUE(near.starts_with(
        "point,instance,distance,error_bound,nearest_x,nearest_y,edge,vertex\n0,i3,-0.25,"))
        << near;
    EXPECT_NE(near.find(",4.5,2,2,\n0,i2,2,"), std::string::npos) << near;
    EXPECT_EQ(folder_.read("hits.csv"), "hit\n0\n1\n");
    EXPECT_EQ(folder_.read("rays.csv"),
              "instance,parameter,error_bound,point_x,point_y,normal_x,normal_y,edge\n"
              ",1,0,,,,,\n");
    EXPECT_TRUE(folder_.read("cast.csv").ends_with("\nseparated,,1,0,0,,,,,,\n"))
        << folder_.read("cast.csv");
}

TEST_F(WorldFiles, RecordsGoIntoNumPyArrays) {
    const Json result = results_of(
        R"({"query": "poses", "shape": "square", "answer": "clearance", "against": "placed",
            "poses": [[2.5, 2, 0], [7, 1, 0]], "max_clearance": 0.75, "values": "clear.npy"},
           {"query": "overlap", "points": [[7, 3], [1.75, 1.75], [10.25, 1.5]],
            "values": "overlap.npy"})");
    const Json names{"bin", "i1", "i2", "i3", "i4"};
    EXPECT_EQ(result.at(0).at("instances"), names);
    EXPECT_EQ(result.at(0).at("columns").size(), 9U);
    EXPECT_EQ(result.at(0).at("columns").at(2), "instance");
    const std::string bytes = folder_.read("clear.npy");
    EXPECT_NE(bytes.find("'<f8', 'fortran_order': False, 'shape': (2, 9)"), std::string::npos);
    const std::vector<double> clear = numbers_of(bytes);
    ASSERT_EQ(clear.size(), 18U);
    EXPECT_DOUBLE_EQ(clear[0], 0.5);
    EXPECT_EQ(clear[2], 1.0) << "i1";
    EXPECT_DOUBLE_EQ(clear[7], -1.0) << "direction_x";
    EXPECT_EQ(clear[9], 0.75);
    EXPECT_EQ(clear[11], -1.0) << "no instance";
    EXPECT_TRUE(std::isnan(clear[12]));
    EXPECT_EQ(result.at(1).at("columns"), Json({"point", "instance"}));
    EXPECT_EQ(numbers_of(folder_.read("overlap.npy")),
              (std::vector<double>{1, 1, 1, 2, 2, 0, 2, 4}));
}

TEST_F(WorldFiles, NamesInCsvAreQuotedWhereTheyNeedIt) {
    const std::string file = folder_.write("names.json", R"({
        "shapes": {"square": {"rings": [[[0, 0], [1, 0], [1, 1], [0, 1]]]}},
        "instances": {"a,\"b\"": {"shape": "square"}},
        "queries": [{"query": "overlap", "points": [[0.5, 0.5]], "values": "names.csv"}]})");
    ASSERT_TRUE(answer({"scene", file}).is_object());
    EXPECT_EQ(folder_.read("names.csv"), "point,instance\n0,\"a,\"\"b\"\"\"\n");
}

TEST_F(WorldFiles, BadTablesAreRefusedByLineAndColumn) {
    const std::string query = R"({"query": "poses", "shape": "square", "poses_file": "t.)";
    const auto expect_bad = [&](const std::string& extension, const std::string& bytes,
                                const std::vector<std::string>& parts) {
        const std::string table = folder_.write("t." + extension, bytes);
        std::vector<std::string> all{"scene.json: queries[0].poses_file: " + table};
        all.insert(all.end(), parts.begin(), parts.end());
        expect_refused({"bench", "--scene", scene(query + extension + "\"}")}, all);
    };
    const std::string form = "expected [x, y, degrees] (three numbers); ";
    expect_bad("csv", "1,2,3\n4,5\n", {"t.csv:2:4: ", form + "the line ends after 2"});
    expect_bad("csv", "1,2,3,4\n", {"t.csv:1:7: ", form + "there are more numbers"});
    expect_bad("csv", "x,y,degrees\n1,two,3\n", {"t.csv:2:3: ", "\"two\" is not a finite number"});
    expect_bad("csv", "x,1,2\n", {"t.csv:1:1: ", "\"x\" is not a finite number"});
    expect_bad("csv", "1,2,3\nx,y,degrees\n", {"t.csv:2:1: ", "\"x\" is not"});
    expect_bad("csv", "inf,nan,-Infinity\n4,5,6\n", {"t.csv:1:1: ", "\"inf\" is not a finite"});
    expect_bad("csv", "1;2;3,4,5\n", {"t.csv:1:5: ", "\"3,4,5\" is not a finite number"});
    expect_bad("csv", "1;2;1.234,5\n", {"t.csv:1:5: ", "\"1.234,5\" is not a finite number"});
    expect_bad("csv", "1;2;3\n1,2,3\n", {"t.csv:2:1: ", "\"1,2,3\" is not a finite number"});
    expect_bad("csv", "1 2 3\n", {"t.csv:1:1: ", "\"1 2 3\" is not a finite number"});
    expect_bad("csv", "\"1\",\"2\",\"3\"\n", {"t.csv:1:1: ", "is not a finite number"});
    expect_bad("csv", "1,2,inf\n", {"t.csv:1:5: ", "\"inf\" is not a finite number"});
    expect_bad("csv", "", {"is empty"});
    expect_bad("csv", "1,2,9e9\n1,2,3\n", {"row 0: ", "too large"});
    expect_bad("csv", "1,2,3\n1,2e12,3\n", {"row 1: ", "y is 2000000000000"});
    expect_bad("npy", npy_of("(1, 2)", {1, 2}), {"expected rows of", "the shape is (1, 2)"});
    expect_bad("npy", npy_of("(3,)", {1, 2, 3}), {"the shape is (3,)"});
    expect_bad("npy", npy_of("(2, 3)", {1, 2, 3}), {"needs 48 bytes, and there are 24"});
    expect_bad("npy", npy_of("(1, 3)", {1, NAN, 3}), {"row 0, column 1: not a finite"});
    expect_bad("npy", npy("{'descr': '<c8', 'fortran_order': False, 'shape': (1, 3)}", {1, 2, 3}),
               {"neither float32, float64 nor whole numbers"});
    expect_bad("npy", npy("{'descr': '<f8', 'shape': (1, 3)}", {1, 2, 3}),
               {"lacks 'fortran_order'"});
    expect_bad("npy", npy_of("(4611686018427387904, 3)", {}), {"too large"});
    expect_bad("npy", npy_of("(1, 3)", {}).substr(0, 20), {"header is cut off"});
    expect_bad("npy", "1,2,3\n", {"does not begin as"});
}

TEST_F(WorldFiles, ValuesReplaceNoInputAndNoOtherOutput) {
    folder_.write("t.csv", "1,1\n");
    const std::string query = R"({"query": "overlap", "points_file": "t.csv", "values": )";
    expect_refused({"scene", scene(query + R"("t.csv"})")}, {"t.csv: would be written over"});
    expect_refused({"scene", scene(query + R"("v.csv"}, )" + query + R"("v.csv"})")},
                   {"v.csv: would be"});
    expect_refused({"scene", scene(query + R"("v.csv"})"), "--json", folder_.path("v.csv")},
                   {"v.csv: would be"});
    expect_refused({"scene", scene(query + R"("none/v.csv"})")}, {"v.csv: cannot be written"});
    // Where a query is not answered nothing is written.
    const std::string bad =
        R"({"query": "cast", "shape": "square", "sweeps": [], "tolerance": 1e99, "values": "c.npy"})";
    EXPECT_EQ(run_program({"scene", scene(bad)}).status, 2);
    EXPECT_FALSE(folder_.contents().contains("c.npy"));
}

}  // namespace
}  // namespace nearfield::test
