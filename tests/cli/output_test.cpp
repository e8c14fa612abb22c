#include "cli_test.hpp"
#include "file_formats.hpp"

#include <cstddef>
#include <map>

namespace nearfield::test {
namespace {

std::vector<std::string> names(const std::map<std::string, std::string>& contents) {
    std::vector<std::string> names;
    for (const auto& [name, bytes] : contents) {
        names.push_back(name);
    }
    return names;
}

class Output : public CliTest {
protected:
    /// A query with every kind of output.
    [[nodiscard]] Arguments field_query() const {
        return squares("distance-field") + Arguments{"-d", "0.1", "--pose-b", "0.6,0.3,0"};
    }
};

TEST_F(Output, AFileHoldsWhatTheStandardOutputWouldAndTheSummaryGoesElsewhere) {
    const Outcome to_file =
        run_program(field_query() + Arguments{"--json", folder_.path("answer.json")});
    ASSERT_EQ(to_file.status, 0) << to_file.err;
    EXPECT_NE(to_file.out.find("distance-field"), std::string::npos) << to_file.out;
    Json in_file = Json::parse(folder_.read("answer.json"));

    const Outcome to_output = run_program(field_query() + Arguments{"--json", "-"});
    ASSERT_EQ(to_output.status, 0) << to_output.err;
    EXPECT_NE(to_output.err.find("distance-field"), std::string::npos) << to_output.err;
    Json on_output = Json::parse(to_output.out);
    in_file.erase("timings_ms");
    on_output.erase("timings_ms");
    EXPECT_EQ(in_file, on_output);
}

TEST_F(Output, WithoutOptionsOnlyASummaryIsPrinted) {
    const auto before = folder_.contents();
    const Outcome outcome = run_program(field_query());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("distance-field"), std::string::npos) << outcome.out;
    EXPECT_EQ(folder_.contents(), before);
}

TEST_F(Output, PicturesArePngOfTheSizeThatTheHelpStates) {
    const Outcome help = run_program({"query", "penetration", "--help"});
    EXPECT_NE(help.out.find("1600 x 1200"), std::string::npos) << help.out;
    for (const auto& query : {"penetration", "intersection", "distance-field"}) {
        const std::string image = std::string(query) + ".png";
        const Outcome outcome =
            run_program(squares(query) + Arguments{"-d", "0.1", "--pose-b", "0.6,0.3,10", "--image",
                                                   folder_.path(image)});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        const PngSize size = parse_png(folder_.read(image));
        EXPECT_EQ(size.width, 1600U) << query;
        EXPECT_EQ(size.height, 1200U) << query;
    }
}

TEST_F(Output, AllOutputsAtOnceReplaceOldOnesAndLeaveNothingElse) {
    const std::string json = folder_.write("answer.json", "old");
    const Outcome outcome =
        run_program(field_query() + Arguments{"--json", json, "--image", folder_.path("i.png"),
                                              "--field", folder_.path("f.npy")});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const std::vector<std::string> expected{"a square.geojson", "answer.json", "b square.wkt",
                                            "f.npy", "i.png"};
    EXPECT_EQ(names(folder_.contents()), expected);
    EXPECT_EQ(Json::parse(folder_.read("answer.json")).at("query"), "distance-field");
}

TEST_F(Output, OneThatCannotBeWrittenKeepsTheOthersFromBeingWritten) {
    const Arguments writable{"--json",  folder_.write("answer.json", "old"),
                             "--image", folder_.path("i.png"),
                             "--field", folder_.path("f.npy")};
    for (std::size_t option = 0; option < writable.size(); option += 2) {
        for (const std::string& target :
             {folder_.path("no such folder/out"), folder_.path(""), a_ + "/out"}) {
            Arguments arguments = writable;
            arguments[option + 1] = target;
            expect_refused(field_query() + arguments, {target, "cannot be written"});
        }
    }
}

TEST_F(Output, NoneMayTakeThePlaceOfAnInputOrOfAnother) {
    expect_refused(field_query() + Arguments{"--json", b_}, {b_});
    expect_refused(field_query() + Arguments{"--json", folder_.path("./a square.geojson")},
                   {"a square.geojson"});
    expect_refused(
        field_query() + Arguments{"--json", folder_.path("x"), "--field", folder_.path("x")},
        {folder_.path("x")});
}

TEST_F(Output, ADiskThatIsFullIsNoSuccess) {
    for (const Arguments& arguments : {field_query(), field_query() + Arguments{"--json", "-"},
                                       Arguments{"info"}, Arguments{"query", "--help"}}) {
        const Outcome outcome = run_program(arguments, {{}, "/dev/full"});
        EXPECT_EQ(outcome.status, 1) << command_line(arguments);
        EXPECT_NE(outcome.err.find("standard output"), std::string::npos) << outcome.err;
    }
    const Outcome outcome = run_program(field_query() + Arguments{"--json", "/dev/full"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("/dev/full"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace nearfield::test
