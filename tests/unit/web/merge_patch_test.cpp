// The difference of two documents, RFC 7396.
#include "clients/web/state/merge_patch.hpp"

#include <gtest/gtest.h>

namespace lockstep::web {
namespace {

using Json = nlohmann::json;

struct Case {
    const char* from;
    const char* to;
    const char* patch;
};

TEST(MergePatch, HasWhatDiffers) {
    const Case cases[] = {
        {R"({"a":1})", R"({"a":1})", "{}"},
        {R"({"a":1})", R"({"a":2})", R"({"a":2})"},
        {R"({"a":1})", R"({"b":1})", R"({"a":null,"b":1})"},
        {R"({"a":{"b":1,"c":2}})", R"({"a":{"b":1,"c":3}})", R"({"a":{"c":3}})"},
        {R"({"a":{"b":1}})", R"({"a":5})", R"({"a":5})"},
        {R"({"a":5})", R"({"a":{"b":1}})", R"({"a":{"b":1}})"},
        {R"({"a":[1,2]})", R"({"a":[1,3]})", R"({"a":[1,3]})"},
        {R"({"a":1})", R"({"a":null})", R"({"a":null})"},
        {R"({})", R"({"a":null})", "{}"},
        {R"({"a":{}})", R"({"a":{"b":null}})", "{}"},
    };
    for (const Case& one : cases) {
        EXPECT_EQ(merge_patch(Json::parse(one.from), Json::parse(one.to)), Json::parse(one.patch))
            << one.from << " " << one.to;
    }
}

/// null and absent are the same to a viewer.
Json without_nulls(const Json& json) {
    if (!json.is_object()) { return json; }
    Json kept = Json::object();
    for (const auto& [name, value] : json.items()) {
        if (!value.is_null()) { kept[name] = without_nulls(value); }
    }
    return kept;
}

TEST(MergePatch, AppliedToTheFirstItGivesTheSecond) {
    const char* documents[] = {R"({})", R"({"a":1,"b":{"c":[1],"d":{"e":"x"}}})",
                               R"({"a":null,"b":{"d":{}},"f":{"g":1}})", R"({"b":3,"f":{"g":null,"h":{"i":[{}]}}})"};
    for (const char* from : documents) {
        for (const char* to : documents) {
            Json document = Json::parse(from);
            document.merge_patch(merge_patch(document, Json::parse(to)));
            EXPECT_EQ(without_nulls(document), without_nulls(Json::parse(to))) << from << " " << to;
        }
    }
}

}  // namespace
}  // namespace lockstep::web
