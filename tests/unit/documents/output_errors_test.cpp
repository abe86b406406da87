// Outputs that a machine cannot have are refused before motion, with their place and a remedy.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "services/documents/machine_file.hpp"
#include "services/documents/machine_rules.hpp"

namespace lockstep {
namespace {

constexpr const char* kAxis = R"(name: "m"
axis {
  name: "X"
  steps_per_mm: 80
  start_velocity_mm_s: 10
  max_velocity_mm_s: 100
  max_accel_mm_s2: 1000
  position_min_mm: 0
  position_max_mm: 100
}
)";

std::string errors_of(const std::string& outputs) {
    const auto machine = parse_machine(kAxis + outputs);
    return machine ? "" : to_text("m", machine.error());
}

TEST(Outputs, AreTakenWithTheirDefaults) {
    const auto machine = parse_machine(std::string(kAxis) +
                                       "output { name: \"laser\" motor: \"X\" use: SPINDLE at_interruption: OFF "
                                       "pwm { hz: 5000 full_scale: 1000 follows_speed: true } }\n");
    ASSERT_TRUE(machine) << to_text("m", machine.error());
    ASSERT_EQ(machine->outputs.size(), 1u);
    const OutputConfig& laser = machine->outputs[0];
    EXPECT_FALSE(laser.stays_at_interruption);
    EXPECT_FALSE(laser.stays_at_fault);
    EXPECT_FALSE(laser.stays_at_silence);
    EXPECT_TRUE(laser.pwm->follows_speed);
    EXPECT_EQ(laser.pwm->full_scale, 1000);
}

TEST(Outputs, ThatCannotBeAreRefusedWithPlaceAndRemedy) {
    struct Case {
        const char* outputs;
        const char* error;
    };
    for (const Case& one : {
             Case{"output { name: \"a\" motor: \"X\" }\noutput { name: \"A\" motor: \"X\" channel: 1 number: 1 }\n",
                  "m:12"},
             Case{"output { name: \"a\" motor: \"Z\" }\n", "it must be one of the machine's motors: X"},
             Case{"output { name: \"a\" motor: \"X\" channel: 16 }\n", "from 0 to 15"},
             Case{"output { name: \"a\" motor: \"X\" }\noutput { name: \"b\" motor: \"X\" number: 1 }\n",
                  "digital output 0 of motor X is given twice"},
             Case{"output { name: \"a\" motor: \"X\" }\noutput { name: \"b\" motor: \"X\" channel: 1 }\n",
                  "has the words of another output"},
             Case{"output { name: \"a\" motor: \"X\" use: MIST pwm { hz: 10 } }\n", "remove pwm"},
             Case{"output { name: \"a\" motor: \"X\" pwm { hz: 300000 } }\n", "hz is 300000"},
             Case{"output { name: \"a\" motor: \"X\" pwm { hz: 10 full_scale: 0 } }\n", "above 0"},
             Case{"output { name: \"a\" motor: \"X\" pwm { hz: 10 follows_speed: true } }\n", "needs use: SPINDLE"},
             Case{"output { name: \"a\" motor: \"X\" number: 64 }\n", "from 0 to 63"},
             Case{"output { name: \"a\" motor: \"X\" pwm { hz: 10 } inverted: true }\n", "cannot be inverted"},
             Case{"output { name: \"a\" motor: \"X\" use: PLACES }\n", "pulse_us is missing"},
             Case{"output { name: \"a\" motor: \"X\" use: PLACES pulse_us: 0.1 }\n", "pulse_us is 0.1"},
             Case{"output { name: \"a\" motor: \"X\" pulse_us: 10 }\n", "remove pulse_us, or use PLACES"},
             Case{"output { name: \"a\" motor: \"X\" use: PLACES pulse_us: 10 pwm { hz: 10 } }\n", "remove pwm"},
             Case{"output { name: \"a\" motor: \"X\" use: PLACES pulse_us: 10 }\n"
                  "output { name: \"b\" motor: \"X\" channel: 1 use: PLACES number: 1 pulse_us: 10 }\n",
                  "can make pulses at places of one output"},
             Case{"output { name: \"a\" motor: \"X\" spin_up_s: 1 }\n", "is no spindle that comes to a speed"},
             Case{"output { name: \"a\" motor: \"X\" use: SPINDLE spin_up_s: 3601 }\n", "spin_up_s is 3601"},
             Case{
                 "output { name: \"a\" motor: \"X\" use: SPINDLE simulated_spin_up_s: 2 }\n",
                 "output a has a simulated spindle, which closes the input at_speed; name an input of the same device"},
             Case{"output { name: \"a\" motor: \"X\" use: SPINDLE at_speed: \"ready\" }\n",
                  "at_speed is \"ready\"; it must be the name of an input"},
             Case{"output { name: \"a\" motor: \"X\" use: SPINDLE pwm { hz: 10 follows_speed: true } spin_up_s: 1 }\n",
                  "is no spindle that comes to a speed"},
             Case{"output { motor: \"X\" }\n", "name is missing"},
             Case{"output { name: \"a\" motor: \"X\" }\noutput_silence_ms: 110\n", "for which a process may stall"},
         }) {
        EXPECT_NE(errors_of(one.outputs).find(one.error), std::string::npos) << one.outputs << errors_of(one.outputs);
    }
}

TEST(Outputs, NeedACoordinationThatSlowsPathsForThem) {
    auto machine = parse_machine(std::string(kAxis) + "output { name: \"a\" motor: \"X\" }\n").value();
    EXPECT_TRUE(output_problems(machine).empty());
    machine.coordination = StepMethod::Lai;
    ASSERT_EQ(output_problems(machine).size(), 1u);
    EXPECT_NE(output_problems(machine)[0].message.find("outputs need coordination: RANADE"), std::string::npos);
}

}  // namespace
}  // namespace lockstep
