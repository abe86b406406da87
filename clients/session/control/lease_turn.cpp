#include "clients/session/control/lease_turn.hpp"

#include "clients/session/lease/login_writer.hpp"

namespace lockstep {

LeaseTurn::LeaseTurn(Session& session, bool takes_over, const StopSignal* stop) : session_(session) {
    session_.write_as(login_writer());
    answer_ = session_.take_lease(takes_over, stop);
}

LeaseTurn::~LeaseTurn() { session_.give_lease(std::chrono::milliseconds{300}); }

}  // namespace lockstep
