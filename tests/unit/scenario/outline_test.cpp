// `scenario check` prints every value of a scenario.
#include <gmock/gmock.h>

#include <functional>

#include "clients/scenario/model/scenario_text.hpp"
#include "tests/unit/scenario/scenario_text.hpp"

namespace lockstep::scenario {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// Returns the block that has a field, in a scenario. Makes it if it is missing.
using BlockIn = std::function<Message*(Asked&)>;

/// The number of values of the field's type that are tried.
int values_of(const FieldDescriptor& field) {
    return field.cpp_type() == FieldDescriptor::CPPTYPE_ENUM ? field.enum_type()->value_count() : 2;
}

void set(Message& block, const FieldDescriptor& field, int value) {
    const auto& reflection = *block.GetReflection();
    const std::string text = value == 0 ? "something" : "anything";
    switch (field.cpp_type()) {
        case FieldDescriptor::CPPTYPE_STRING:
            return field.is_repeated() ? reflection.AddString(&block, &field, text)
                                       : reflection.SetString(&block, &field, text);
        case FieldDescriptor::CPPTYPE_BOOL: return reflection.SetBool(&block, &field, value == 1);
        case FieldDescriptor::CPPTYPE_INT32: return reflection.SetInt32(&block, &field, 3 + value);
        case FieldDescriptor::CPPTYPE_DOUBLE: return reflection.SetDouble(&block, &field, 1.25 * (1 + value));
        case FieldDescriptor::CPPTYPE_ENUM: return reflection.SetEnum(&block, &field, field.enum_type()->value(value));
        default: FAIL() << "extend this test for the type of " << field.full_name();
    }
}

Message* inner_block(Message& block, const FieldDescriptor& field) {
    const auto& reflection = *block.GetReflection();
    Message* inner =
        field.is_repeated() ? reflection.AddMessage(&block, &field) : reflection.MutableMessage(&block, &field);
    // A scenario with an empty block of an axis's end is refused.
    if (auto* end = dynamic_cast<Asked::AxisEnd*>(inner)) { end->set_homed(true); }
    return inner;
}

class Outline : public testing::Test {
protected:
    std::string with(const BlockIn& block_in, const FieldDescriptor& field, int value) const {
        Scenario scenario{.file = "here.textproto", .asked = {}, .machine = machine_};
        set(*block_in(scenario.asked), field, value);
        return outline(scenario);
    }
    void expect_printed(const BlockIn& block_in, const FieldDescriptor& field) {
        ++fields_;
        for (int a = 0; a < values_of(field); ++a) {
            for (int b = 0; b < a; ++b) {
                EXPECT_NE(with(block_in, field, a), with(block_in, field, b)) << field.full_name() << " is not printed";
            }
        }
    }
    void walk(const Descriptor& type, const BlockIn& block_in) {
        for (int i = 0; i < type.field_count(); ++i) {
            const FieldDescriptor& field = *type.field(i);
            const Descriptor* inner = field.message_type();
            if (inner == nullptr) {
                expect_printed(block_in, field);
            } else if (inner != proto::Machine::descriptor()) {  // another command prints a machine
                walk(*inner, [&](Asked& asked) { return inner_block(*block_in(asked), field); });
            }
        }
    }

    MachineSetup machine_ = parsed(whole("")).machine;
    int fields_ = 0;
};

TEST_F(Outline, PrintsEveryFieldWithItsValue) {
    walk(*Asked::descriptor(), [](Asked& asked) { return &asked; });
    EXPECT_GT(fields_, 60);
}

TEST_F(Outline, NamesExpectationsAsTheChecksDo) {
    const std::string text =
        outline(parsed(whole("step { run { gcode: \"G90\\nG1 X10 F600\" } during { line: 2 act { command: HOLD } } }\n"
                             "expect { interruptions: 2 phase: IDLE axis { name: \"X\" homed: true heard: true }\n"
                             "  axis { name: \"Y\" fault: \"none\" } exact: false }")));
    for (const char* part :
         {"expect   2 interruptions of jobs", "expect   the machine is Idle at the end", "expect   X homed",
          "expect   X received", "expect   Y has fault none", "skip     every step as planned", "| G1 X10 F600"}) {
        EXPECT_THAT(text, testing::HasSubstr(part));
    }
}

TEST_F(Outline, NamesOneInterruptionAsOne) {
    EXPECT_THAT(outline(parsed(whole("expect { interruptions: 1 }"))),
                testing::HasSubstr("expect   1 interruption of jobs"));
}

}  // namespace
}  // namespace lockstep::scenario
