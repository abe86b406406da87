// Takes the machine's state from a session, for the server's thread.
#pragma once

#include <optional>
#include <vector>

#include "clients/session/session.hpp"
#include "clients/web/state/snapshot.hpp"

namespace lockstep::web {

class SnapshotTaker {
public:
    /// `session` must outlive this object.
    explicit SnapshotTaker(const Session& session)
        : session_(session), healths_(session.received().kinematics().motors().size()) {}

    /// Notes when figures of the axes came. Call it when the session has received messages.
    void note_healths();
    /// Without the server's own job and the machine's writer.
    Snapshot take() const;

private:
    AxisSnapshot axis(AxisIndex axis) const;
    std::vector<MotorSnapshot> motors() const;

    const Session& session_;
    std::vector<std::optional<Seen<AxisHealth>>> healths_;
};

}  // namespace lockstep::web
