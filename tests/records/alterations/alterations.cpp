#include "tests/records/alterations/alterations.hpp"

namespace lockstep::records {

const std::vector<Alteration>& alterations() {
    static const std::vector<Alteration> all = [] {
        std::vector<Alteration> list;
        for (const auto& some :
             {step_alterations(), inserted_steps(), run_alterations(), job_alterations(), program_alterations(),
              event_alterations(), mark_alterations(), sample_alterations(), order_alterations(),
              machine_alterations()}) {
            list.insert(list.end(), some.begin(), some.end());
        }
        return list;
    }();
    return all;
}

bool Base::fulfils(const Needs& needs) const {
    return (has.events || !needs.events) && (has.overrides || !needs.overrides) && (has.clocks || !needs.clocks) &&
           (has.parts || !needs.parts) && (has.restart || !needs.restart) &&
           (has.shared_clock || !needs.shared_clock) && (has.whole_program || !needs.whole_program);
}

}  // namespace lockstep::records
