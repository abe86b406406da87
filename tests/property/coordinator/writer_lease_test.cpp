// There is at most one writer at a time, for any requests and silences of clients. A simple model gives the writer.
#include "core/coordinator/writer_lease.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace lockstep {
namespace {

constexpr Slot kSilence = kLeaseSilence_ms + 1;  // slots of 1 ms

/// Every client that has ever asked, with its writer and when it was received last. The last takeover counts.
struct Model {
    struct Client {
        std::uint64_t writer = 0;
        Slot received = 0;
    };
    std::uint64_t writer = 0;  // 0: none
    std::map<Identity, Client> clients;

    void forget(Slot now) {
        std::erase_if(clients, [&](const auto& entry) { return now - entry.second.received > kSilence; });
        settle();
    }
    void settle() {
        std::erase_if(clients, [&](const auto& entry) { return entry.second.writer != writer; });
        if (clients.empty()) { writer = 0; }
    }
    bool take(Identity client, std::uint64_t by, bool takes_over, Slot now) {
        if (writer != 0 && writer != by && !takes_over) { return false; }
        writer = by;
        clients[client] = {by, now};
        settle();
        return true;
    }
    void give(Identity client) {
        clients.erase(client);
        settle();
    }
};

/// Ten clients of four writers.
std::uint64_t writer_of(Identity client) { return 1 + client % 4; }

TEST(WriterLeases, AreAsAModelSaysForRandomClients) {
    std::mt19937_64 random(1);
    const MachineConfig machine{.timing = {.slot_us = 1000}};
    int refused = 0;
    int lost = 0;
    for (int run = 0; run < 500; ++run) {
        WriterLease lease(machine);
        Model model;
        Slot now = 1000;
        std::uint64_t asked = 0;
        for (int step = 0; step < 200; ++step) {
            const Slot pause = random() % 8 == 0 ? static_cast<Slot>(random() % (2 * kSilence)) : random() % 300;
            for (const Slot end = now + pause; now < end;) { lease.tend(++now, 0); }
            const bool had_writer = model.writer != 0;
            model.forget(now);
            lost += had_writer && model.writer == 0 ? 1 : 0;
            const Identity client = 1 + random() % 10;
            const bool takes_over = random() % 6 == 0;
            if (random() % 4 == 0) {
                lease.give(client);
                model.give(client);
            } else {
                Command command{
                    .client = client, .sequence = ++asked, .kind = CommandKind::TakeLease, .takes_over = takes_over};
                command.writer = {.id = writer_of(client), .name = "w", .host = "h"};
                const bool is_taken = lease.take(command, Tick{now * 1000}, now).has_value();
                ASSERT_EQ(is_taken, model.take(client, writer_of(client), takes_over, now));
                refused += is_taken ? 0 : 1;
            }
            ASSERT_EQ(lease.held() ? lease.held()->writer.id : 0, model.writer) << "run " << run << ", step " << step;
            for (std::uint64_t writer = 0; writer <= 4; ++writer) {
                const bool may = lease.check(writer, Tick{now * 1000}).has_value();
                ASSERT_EQ(may, model.writer == 0 || model.writer == writer);
            }
        }
    }
    EXPECT_GT(refused, 1000);
    EXPECT_GT(lost, 100);
}

}  // namespace
}  // namespace lockstep
