#include "clients/grbl/protocol/code_table.hpp"

#include <algorithm>
#include <array>

namespace lockstep::grbl {
namespace {

constexpr std::string_view kOneNumber = "reported as error 20";

constexpr std::array kErrors{
    Code{1, "Expected command letter", "A word of the line does not begin with a letter."},
    Code{2, "Bad number format", "A number is missing, or is not written as one."},
    Code{3, "Invalid statement", "There is no such $ command or setting."},
    Code{4, "Value < 0", "The value of a setting is below 0."},
    Code{5, "Setting disabled", "Homing is switched off in the settings.", "homing is always possible"},
    Code{6, "Value < 3 usec", "The step pulse of the setting is too short.", "the pulse time cannot be set"},
    Code{7, "EEPROM read fail", "Stored settings could not be read; the defaults apply.",
         "a machine does not start with settings that cannot be read"},
    Code{8, "Not idle", "This $ command is for a machine at rest."},
    Code{9, "G-code lock", "No line is accepted in alarm, during a jog, or while another writer has the machine."},
    Code{10, "Homing not enabled", "Soft limits need homing.", "the travel is always checked"},
    Code{11, "Line overflow", "The line is too long, or finds no room in the receive buffer. It was not run."},
    Code{12, "Step rate > 30kHz", "The setting asks for more steps per second than the controller makes.",
         "reported as error 101"},
    Code{13, "Check Door", "The safety door is open.", "there is no door"},
    Code{14, "Line length exceeded", "The build info or start-up line is too long to store.", "none is stored"},
    Code{15, "Travel exceeded", "The target is outside the travel. The line was not run."},
    Code{16, "Invalid jog command", "The jog has no = or a word that jogs do not have."},
    Code{17, "Setting disabled", "Laser mode needs a PWM output.", "there is no laser mode"},
    Code{20, "Unsupported command", "The line has a command that is not supported or not valid."},
    Code{21, "Modal group violation", "Two commands of the line exclude each other."},
    Code{22, "Undefined feed rate", "No feed rate has been set."},
    Code{23, "Invalid gcode ID:23", "A command needs a whole number.", kOneNumber},
    Code{24, "Invalid gcode ID:24", "Two commands of the line use the axis words."},
    Code{25, "Invalid gcode ID:25", "A word comes twice."},
    Code{26, "Invalid gcode ID:26", "The line needs axis words and has none."},
    Code{27, "Invalid gcode ID:27", "The line number is not valid.", kOneNumber},
    Code{28, "Invalid gcode ID:28", "A command lacks a word that it needs.", kOneNumber},
    Code{29, "Invalid gcode ID:29", "This work coordinate system is not supported.", "G59.1 to G59.3 are supported"},
    Code{30, "Invalid gcode ID:30", "G53 is for G0 and G1 only.", kOneNumber},
    Code{31, "Invalid gcode ID:31", "The line has axis words that nothing uses.", kOneNumber},
    Code{32, "Invalid gcode ID:32", "An arc has no axis word in its plane.", kOneNumber},
    Code{33, "Invalid gcode ID:33", "The target of the motion is not valid."},
    Code{34, "Invalid gcode ID:34", "The radius of an arc is not valid.", "reported as error 33"},
    Code{35, "Invalid gcode ID:35", "An arc has no offset word in its plane.", kOneNumber},
    Code{36, "Invalid gcode ID:36", "The line has words that nothing uses.", kOneNumber},
    Code{37, "Invalid gcode ID:37", "G43.1 is for the axis of the tool's length only.", kOneNumber},
    Code{38, "Invalid gcode ID:38", "The number of the tool is too large.", kOneNumber},
    Code{100, "Setting fixed", "This setting has one value on this machine."},
    Code{101, "Setting out of range", "The machine cannot have this value. A message gives the reason."},
    Code{102, "Setting not kept", "The setting could not be stored and is unchanged. A message gives the reason."},
};

constexpr std::array kAlarms{
    Code{1, "Hard limit", "A limit switch was hit. Home the machine again."},
    Code{2, "Soft limit", "The target of a line is outside the travel. The position is kept. Unlock with $X."},
    Code{3, "Abort during cycle",
         "A motion ended before its end, by a fault or by another client. A message gives the reason. Unlock with $X."},
    Code{4, "Probe fail", "The probe touched before its move began. Move it away. Unlock with $X."},
    Code{5, "Probe fail", "The probe did not touch within its move. Unlock with $X."},
    Code{6, "Homing fail", "Homing was reset.", "a reset stops the machine on its path and is not an alarm"},
    Code{7, "Homing fail", "The safety door was opened during homing.", "there is no door"},
    Code{8, "Homing fail", "The switch did not open behind the pull-off, or is not steady. Check switch and wiring."},
    Code{9, "Homing fail", "The switch was not found within the travel. Check switch and wiring."},
};

}  // namespace

std::span<const Code> error_codes() { return kErrors; }
std::span<const Code> alarm_codes() { return kAlarms; }

const Code* find_code(std::span<const Code> codes, int number) {
    const auto found = std::ranges::find(codes, number, &Code::number);
    return found == codes.end() ? nullptr : &*found;
}

}  // namespace lockstep::grbl
