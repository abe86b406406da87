#include "tests/records/kinds/kinds.hpp"

namespace lockstep::records {

const std::vector<RecordKind>& record_kinds() {
    static const std::vector<RecordKind> all = [] {
        std::vector<RecordKind> kinds;
        for (const auto& some : {path_kinds(), file_kinds(), interruption_kinds(), own_move_kinds(), process_kinds(),
                                 machine_kinds(), file_of_log_kinds()}) {
            kinds.insert(kinds.end(), some.begin(), some.end());
        }
        return kinds;
    }();
    return all;
}

Record recorded_program(const MachineSetup& machine, const std::string& gcode) {
    MachineRun run(machine);
    run.home();
    run.run(gcode);
    run.wait_ms(200);
    return run.finish();
}

Record recorded_program(const std::string& gcode) { return recorded_program(small_mill(), gcode); }

}  // namespace lockstep::records
