#include "tests/records/alterations/alterations.hpp"

#include <map>

namespace lockstep::records {

const std::vector<Alteration>& alterations() {
    static const std::vector<Alteration> all = [] {
        std::vector<Alteration> list;
        for (const auto& some : {step_alterations(), inserted_steps(), run_alterations(), job_alterations(),
                                 program_alterations(), event_alterations(), output_alterations(), mark_alterations(),
                                 sample_alterations(), order_alterations(), machine_alterations()}) {
            list.insert(list.end(), some.begin(), some.end());
        }
        return list;
    }();
    return all;
}

bool Base::fulfils(const Needs& needs) const {
    return (has.events || !needs.events) && (has.outputs || !needs.outputs) && (has.overrides || !needs.overrides) &&
           (has.clocks || !needs.clocks) && (has.parts || !needs.parts) && (has.restart || !needs.restart) &&
           (has.shared_clock || !needs.shared_clock) && (has.whole_program || !needs.whole_program) &&
           (has.all_motions || !needs.all_motions);
}

const Record& record_of(const Base& base) {
    static std::map<std::string, Record> made;
    const auto found = made.find(base.name);
    return found != made.end() ? found->second : made.emplace(base.name, base.make()).first->second;
}

std::vector<AlteredBase> altered_bases() {
    std::vector<AlteredBase> all;
    for (const Base& base : bases()) {
        for (const Alteration& alteration : alterations()) {
            if (!base.fulfils(alteration.needs)) { continue; }
            Record record = record_of(base);
            if (alteration.alter(record)) { all.push_back({base, alteration}); }
        }
    }
    return all;
}

}  // namespace lockstep::records
