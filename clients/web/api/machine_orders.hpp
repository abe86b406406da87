// Carries out the orders of clients: gives them to the machine, after reading the programs that they run.
#pragma once

#include "clients/web/machine/port.hpp"
#include "clients/web/program/mdi_session.hpp"
#include "clients/web/program/program_desk.hpp"

namespace lockstep::web {

class MachineOrders {
public:
    /// All must outlive this object.
    MachineOrders(const MachineSetup& machine, MachinePort& port, ProgramDesk& desk, MdiSession& mdi)
        : machine_(machine), port_(port), desk_(desk), mdi_(mdi) {}

    /// Calls `done` once, from any thread.
    void carry_out(const Order& order, const Done& done);

private:
    void run(const RunOrder& order, const Done& done);
    void run_ready(std::expected<ReadyProgram, Problem> ready, const Done& done);
    void run_line(const MdiOrder& order, const Done& done);
    void touch(const TouchOrder& order, const Done& done);
    void measure(const MeasureOrder& order, const Done& done);
    void keep(const KeepOrder& order, const Done& done);

    const MachineSetup& machine_;
    MachinePort& port_;
    ProgramDesk& desk_;
    MdiSession& mdi_;
};

}  // namespace lockstep::web
