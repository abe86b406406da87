#include "clients/session/control/lease_turn.hpp"

#include "clients/session/lease/login_writer.hpp"
#include "clients/session/waits.hpp"

namespace lockstep {

LeaseTurn::LeaseTurn(Session& session, bool takes_over, const StopSignal* stop) : session_(session) {
    session_.lease().write_as(login_writer());
    answer_ = take_lease(session_, takes_over, stop);
}

LeaseTurn::~LeaseTurn() { give_lease(session_, kGivePatience); }

}  // namespace lockstep
