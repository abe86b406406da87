// A result lists the failed checks, as text and in XML.
#include "clients/scenario/model/report.hpp"

#include <gmock/gmock.h>
#include <tinyxml2.h>

namespace lockstep::scenario {
namespace {

using testing::HasSubstr;

proto::ScenarioReport scenario(const std::string& name, bool held) {
    proto::ScenarioReport report;
    report.set_file("folder/" + name + ".textproto");
    report.set_shows("a < b & c");
    report.set_held(held);
    Check& check = *report.add_checks();
    check.set_asked("X at 10 mm");
    check.set_found("at 9 mm");
    check.set_where("whole.lcm, tick 7");
    check.set_held(held);
    return report;
}

TEST(ScenarioReport, NamesFailuresAndTheirPlace) {
    const std::string text = to_text(scenario("plate", false), false);
    EXPECT_THAT(text, HasSubstr("plate: FAILED"));
    EXPECT_THAT(text, HasSubstr("FAILED  X at 10 mm: at 9 mm (whole.lcm, tick 7)"));
}

TEST(ScenarioReport, JUnitCountsCasesFailuresAndErrors) {
    proto::ScenarioRunReport all;
    *all.add_scenarios() = scenario("good", true);
    *all.add_scenarios() = scenario("bad", false);
    *all.add_scenarios() = scenario("broken", false);
    all.mutable_scenarios(2)->set_broken("no network");
    tinyxml2::XMLDocument xml;
    ASSERT_EQ(xml.Parse(junit_xml(all).c_str()), tinyxml2::XML_SUCCESS);
    const auto* suite = xml.RootElement()->FirstChildElement("testsuite");
    EXPECT_EQ(suite->IntAttribute("tests"), 3);
    EXPECT_EQ(suite->IntAttribute("failures"), 1);
    EXPECT_EQ(suite->IntAttribute("errors"), 1);
    const auto* bad = suite->FirstChildElement("testcase")->NextSiblingElement();
    EXPECT_STREQ(bad->Attribute("name"), "bad");
    EXPECT_THAT(bad->FirstChildElement("failure")->Attribute("message"), HasSubstr("X at 10 mm: at 9 mm"));
    EXPECT_STREQ(suite->LastChildElement()->FirstChildElement("error")->Attribute("message"), "no network");
}

}  // namespace
}  // namespace lockstep::scenario
