// The test acts as sender and as machine: the answers of grbl's protocol, and its requests to the machine.
#include "tests/unit/grbl/hand_sender.hpp"

#include <random>

namespace lockstep::grbl {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

TEST_F(Sender, IsGreeted) {
    grbl.greet();
    EXPECT_THAT(lines(), ElementsAre("", "Grbl 1.1h ['$' for help]"));
    view.axes[1].homed = false;
    grbl.see(view);
    grbl.greet();
    EXPECT_THAT(lines(), ElementsAre("", "Grbl 1.1h ['$' for help]", "[MSG:'$H'|'$X' to unlock]"));
}

TEST_F(Sender, GetsOneAnswerForEachLine) {
    EXPECT_THAT(send("\n"), ElementsAre("ok"));
    EXPECT_THAT(send("\r\n(nothing)\r\n"), ElementsAre("ok", "ok"));
    EXPECT_THAT(send("$\n"), ElementsAre(StartsWith("[HLP:"), "ok"));
    EXPECT_THAT(send("$Q\n$12\n$\x01\n"), ElementsAre("error:3", "error:3", "error:3"));
    EXPECT_THAT(send(" $ g \n"), ElementsAre("[GC:G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]", "ok"));
    EXPECT_THAT(send("$I\n"), ElementsAre(StartsWith("[VER:1.1h."), StartsWith("[OPT:NH,128,4096"), "ok"));
    EXPECT_THAT(send("$N\n$N0=\n$N0=G20\n"), ElementsAre("$N0=", "$N1=", "ok", "ok", StartsWith("[MSG:"), "error:3"));
}

TEST_F(Sender, HasRealTimeBytesTakenOutOfALine) {
    EXPECT_THAT(send("G2?1\nG2\x85"
                     "0\n"),
                ElementsAre(StartsWith("<Idle|"), "ok", "ok"));
    EXPECT_THAT(send("$G\n")[0], HasSubstr("G20"));
}

TEST_F(Sender, LearnsWhereTheMachineIs) {
    EXPECT_EQ(status(), "<Idle|MPos:10.000,20.000,30.000|FS:0,0|WCO:0.000,0.000,0.000>");
    EXPECT_EQ(status(), "<Idle|MPos:10.000,20.000,30.000|FS:0,0|Ov:100,100,100>");
    EXPECT_EQ(status(), "<Idle|MPos:10.000,20.000,30.000|FS:0,0>");
    view.values.systems[0].origin = {1, 2, 3};
    view.feed_mm_min = 599.7;
    view.line = 7;
    change(MachinePhase::Running);
    EXPECT_EQ(status(), "<Run|MPos:10.000,20.000,30.000|Ln:7|FS:600,0|WCO:1.000,2.000,3.000>");
    EXPECT_THAT(send("$10=2\n$13=1\n"), ElementsAre("ok", "ok"));
    EXPECT_THAT(status(), StartsWith("<Run|WPos:0.3543,0.7087,1.0630|Bf:128,4096|Ln:7|FS:24,0"));
    change(MachinePhase::Holding);
    EXPECT_THAT(status(), HasSubstr("|Ln:7|")) << "the line in which it is held";
    EXPECT_THAT(send("?????"), testing::SizeIs(1)) << "a flood is one question";
}

TEST_F(Sender, SeesWhichSwitchesAreClosed) {
    view.closed_switches = "XZ";
    grbl.see(view);
    EXPECT_EQ(status(), "<Idle|MPos:10.000,20.000,30.000|FS:0,0|Pn:XZ|WCO:0.000,0.000,0.000>");
    view.closed_switches = "";
    grbl.see(view);
    EXPECT_THAT(status(), testing::Not(HasSubstr("|Pn:")));
}

TEST_F(Sender, SeesThatAProbeTouches) {
    MachineSetup machine = mill();
    machine.inputs = {{.name = "plate", .motor = "Y", .channel = 3, .use = InputUse::Probe, .number = 0}};
    view.closed_inputs = letters_of_inputs(machine, [](std::size_t) { return 8U; });
    grbl.see(view);
    EXPECT_THAT(status(), HasSubstr("|Pn:P|"));
}

TEST_F(Sender, SeesThatADoorIsOpenOrAnEmergencyStopIsPressed) {
    MachineSetup machine = mill();
    machine.inputs = {{.name = "stop", .motor = "Y", .channel = 3, .use = InputUse::EmergencyStop},
                      {.name = "door", .motor = "X", .channel = 4, .use = InputUse::Door}};
    view.closed_switches = "X";
    view.closed_inputs = letters_of_inputs(machine, [](std::size_t) { return 0x18U; });
    grbl.see(view);
    EXPECT_THAT(status(), HasSubstr("|Pn:XDE|"));
    EXPECT_EQ(letters_of_inputs(machine, [](std::size_t motor) { return motor == 0 ? 0x18U : 0U; }), "D");
}

TEST_F(Sender, GetsOffsetsAndOverridesAsOftenAsFromGrbl) {
    const auto distances_of = [&](const std::string& field) {
        std::vector<int> distances;
        for (int k = 0, last = -1; k < 70; ++k) {
            if (status().find(field) == std::string::npos) { continue; }
            if (last >= 0) { distances.push_back(k - last); }
            last = k;
        }
        return distances;
    };
    EXPECT_THAT(distances_of("|WCO:"), testing::Each(10));
    EXPECT_THAT(distances_of("|Ov:"), testing::Each(10));
    for (const MachinePhase phase : {MachinePhase::Running, MachinePhase::Holding, MachinePhase::Homing}) {
        change(phase);
        for (int k = 0; k < 30; ++k) { (void)status(); }
        EXPECT_THAT(distances_of("|WCO:"), testing::AllOf(testing::SizeIs(testing::Ge(1)), testing::Each(30)));
        EXPECT_THAT(distances_of("|Ov:"), testing::AllOf(testing::SizeIs(testing::Ge(2)), testing::Each(20)));
    }
}

TEST_F(Sender, SeesEachStateByItsName) {
    for (const auto& [phase, name] : {std::pair{MachinePhase::Homing, "<Home|"},
                                      {MachinePhase::Running, "<Run|"},
                                      {MachinePhase::Holding, "<Hold:0|"},
                                      {MachinePhase::Paused, "<Hold:0|"},
                                      {MachinePhase::Stopping, "<Hold:1|"},
                                      {MachinePhase::Jogging, "<Jog|"},
                                      {MachinePhase::Waiting, "<Alarm|"}}) {
        change(phase);
        EXPECT_THAT(status(), StartsWith(name));
    }
    view.is_received = false;
    change(MachinePhase::Idle);
    EXPECT_THAT(status(), StartsWith("<Alarm|"));
}

TEST_F(Sender, ReadsTheMachinesSettingsAndThoseOfItsConnection) {
    const auto settings = send("$$\n");
    EXPECT_THAT(settings, testing::IsSupersetOf({"$10=1", "$23=7", "$24=60.000", "$25=300.000", "$27=2.000",
                                                 "$100=100.000", "$112=3000.000", "$121=500.000", "$130=200.000"}));
    EXPECT_EQ(settings.back(), "ok");
    EXPECT_THAT(send("$110=3000\n"), ElementsAre("ok")) << "as it is";
    EXPECT_THAT(send("$32=1\n"),
                ElementsAre("[MSG:$32 is always 0 on this machine: the machine has no spindle]", "error:100"));
    EXPECT_THAT(send("$99=1\n$10=x\n$10=\n$=1\n$110=-5\n"),
                ElementsAre("[MSG:there is no $99]", "error:3", "error:2", "error:2", "error:3", "error:4"));
    EXPECT_THAT(send("$23=8\n"), ElementsAre("[MSG:$23 must be a whole number from 0 to 7]", "error:101"));
    EXPECT_THAT(asked(), ElementsAre());
}

TEST_F(Sender, WritesSettingsThatAreInForceLater) {
    EXPECT_THAT(send("$111=1500\n"), ElementsAre()) << "answered when it is kept";
    ASSERT_THAT(asked(), ElementsAre(Kind::KeepSettings));
    EXPECT_EQ(requests[0].settings, (KeptSettings{{"Y", "max_velocity_mm_s", "25"}}));
    MachineSetup next = mill();
    next.axes[1].max_velocity_mm_s = 25;
    grbl.see_next(next);
    grbl.answer(requests[0].number, {.is_done = true});
    EXPECT_THAT(lines(), ElementsAre("[MSG:$111 is stored and applies after: lockstep down; lockstep up]", "ok"));
    const auto settings = send("$$\n");
    EXPECT_THAT(settings, testing::Contains("$111=1500.000"));
    EXPECT_EQ(settings[settings.size() - 2], "[MSG:$111 applies after: lockstep down; lockstep up]");
    EXPECT_THAT(send("$111=1500\n"), ElementsAre("ok")) << "it is kept already";
    EXPECT_THAT(asked(), ElementsAre());
}

TEST_F(Sender, WritesEachSettingAsKeysOfTheMachinesFile) {
    const auto keys = [&](const std::string& line) {
        (void)send(line + "\n");
        if (asked().size() != 1) { return KeptSettings{}; }
        grbl.answer(requests[0].number, {.is_done = true});
        return requests[0].settings;
    };
    EXPECT_EQ(keys("$100=80"), (KeptSettings{{"X", "steps_per_mm", "80"}}));
    EXPECT_EQ(keys("$110=1000"), (KeptSettings{{"X", "max_velocity_mm_s", "16.666666666666668"}}));
    EXPECT_EQ(keys("$122=250.5"), (KeptSettings{{"Z", "max_accel_mm_s2", "250.5"}}));
    EXPECT_EQ(keys("$131=150"), (KeptSettings{{"Y", "position_max_mm", "150"}}));
    EXPECT_EQ(keys("$23=5"), (KeptSettings{{"Y", "homing.toward_min", "false"}}));
    EXPECT_EQ(keys("$27=1"),
              (KeptSettings{
                  {"X", "homing.pulloff_mm", "1"}, {"Y", "homing.pulloff_mm", "1"}, {"Z", "homing.pulloff_mm", "1"}}));
    EXPECT_EQ(keys("$25=600")[2], (KeptSetting{"Z", "homing.search_velocity_mm_s", "10"}));
    EXPECT_EQ(keys("$24=30")[0], (KeptSetting{"X", "homing.latch_velocity_mm_s", "0.5"}));
    MachineSetup upward = mill();
    upward.axes[2].homing.toward_min = false;
    grbl.see_next(upward);
    EXPECT_EQ(keys("$132=150"), (KeptSettings{{"Z", "position_min_mm", "50"}})) << "its switch is above";
}

TEST_F(Sender, IsToldWhyASettingIsNotKept) {
    (void)send("$110=1\n");
    (void)asked();
    grbl.answer(requests[0].number, {.text = "axis X: too slow", .error = Error::SettingOutOfRange});
    EXPECT_THAT(lines(), ElementsAre("[MSG:axis X: too slow]", "error:101"));
    change(MachinePhase::Running);
    EXPECT_THAT(send("$110=1000\n"), ElementsAre("error:8"));
}

TEST_F(Sender, ForgetsTheSettingsThatItHasWritten) {
    (void)send("$RST=$\n");
    ASSERT_THAT(asked(), ElementsAre(Kind::DropSettings));
    grbl.answer(requests[0].number, {.is_done = true});
    EXPECT_THAT(lines(), ElementsAre("[MSG:Restoring defaults]", "ok"));
    (void)send("$RST=*\n");
    ASSERT_THAT(asked(), ElementsAre(Kind::SetValues));
    EXPECT_TRUE(requests[0].drops_settings);
}

TEST_F(Sender, ReadsTheOffsets) {
    view.values.systems[1].origin = {1, 2, 3};
    view.values.home = gcode::Point{7, 8, 9};
    grbl.see(view);
    const auto found = send("$#\n");
    EXPECT_THAT(found, ElementsAre("[G54:0.000,0.000,0.000]", "[G55:1.000,2.000,3.000]", "[G56:0.000,0.000,0.000]",
                                   "[G57:0.000,0.000,0.000]", "[G58:0.000,0.000,0.000]", "[G59:0.000,0.000,0.000]",
                                   "[G28:7.000,8.000,9.000]", "[G30:5.000,5.000,5.000]", "[G92:0.000,0.000,0.000]",
                                   "[TLO:0.000]", "[PRB:0.000,0.000,0.000:0]", "ok"));
    EXPECT_THAT(send("$RST=#\n"), ElementsAre());
    ASSERT_THAT(asked(), ElementsAre(Kind::SetValues));
    EXPECT_EQ(requests[0].values, gcode::KeptValues{});
    grbl.answer(requests[0].number, {.is_done = true});
    EXPECT_THAT(lines(), ElementsAre("[MSG:Restoring defaults]", "ok"));
}

TEST_F(Sender, IsToldWhyTheMachinePausesInThatMoment) {
    view.pause = Pause{PauseReason::ToolChange, 2, "6 mm end mill"};
    change(MachinePhase::Paused);
    EXPECT_THAT(lines(), ElementsAre("[MSG:Change to tool 2: 6 mm end mill]"));
    change(MachinePhase::Paused);
    EXPECT_THAT(lines(), IsEmpty()) << "once";
    (void)send("~");
    EXPECT_THAT(asked(), ElementsAre(Kind::Resume));
    view.pause.reset();
    change(MachinePhase::Running);
    view.pause = Pause{};
    change(MachinePhase::Paused);
    EXPECT_THAT(lines(), ElementsAre("[MSG:Program stop]"));
}

TEST_F(Sender, JogsInAPauseAndResumesOnlyAtItsPlace) {
    view.pause = Pause{};
    change(MachinePhase::Paused);
    (void)lines();
    (void)send("$J=G91 X5 F600\n");
    EXPECT_THAT(asked(), ElementsAre(Kind::Jog));
    grbl.answer(requests.back().number, {.is_done = true});
    grbl.end_jog();
    (void)lines();
    view.way_back = "X to 10 mm";
    change(MachinePhase::Paused);
    EXPECT_THAT(send("~"), ElementsAre(HasSubstr("way back: X to 10 mm; jog them back, or let the machine return")));
    EXPECT_THAT(asked(), IsEmpty());
}

TEST_F(Sender, HoldsResumesAndStops) {
    EXPECT_THAT(send("!~\x18"), ElementsAre("", StartsWith("Grbl 1.1h")));
    EXPECT_THAT(asked(), ElementsAre()) << "nothing moves";
    change(MachinePhase::Running);
    (void)send("!");
    EXPECT_THAT(asked(), ElementsAre(Kind::Hold));
    (void)send("\x84");
    EXPECT_THAT(asked(), ElementsAre(Kind::Hold));
    change(MachinePhase::Holding);
    (void)send("~");
    EXPECT_THAT(asked(), ElementsAre(Kind::Resume));
    (void)send("\x18");
    EXPECT_THAT(asked(), ElementsAre(Kind::Stop));
}

TEST_F(Sender, TurnsTheOverrides) {
    (void)send("\x91\x91\x93\x96");
    asked();
    EXPECT_EQ(requests.back().overrides, (Overrides{121, 50}));
    (void)send("\x92\x94\x97");
    asked();
    EXPECT_EQ(requests.back().overrides, (Overrides{110, 25}));
    (void)send(std::string(50, '\x91'));
    asked();
    EXPECT_EQ(requests.back().overrides.feed_percent, 200);
    (void)send("\x90\x95\x9e\xa0\xa1\xff");
    asked();
    EXPECT_EQ(requests.back().overrides, Overrides{});
}

TEST_F(Sender, AJogThatWouldBeTooSlowIsRefused) {
    for (const char* line : {"$J=G91 X3 F0.0005\n", "$J=G91 X3 F0.00000000000001\n", "$J=G91 X3 Y0.1 F0.01\n"}) {
        EXPECT_THAT(send(line),
                    ElementsAre("[MSG:F is too slow; each axis must move at 0.0006 mm/min or more]", "error:22"))
            << line;
        EXPECT_THAT(asked(), ElementsAre());
    }
    EXPECT_THAT(send("$J=G91 X3 F0.0007\n"), ElementsAre());
    EXPECT_THAT(asked(), ElementsAre(Kind::Jog));
}

TEST_F(Sender, JogsAndCancels) {
    EXPECT_THAT(send("$J=G91 X3 Y4 F600\n"), ElementsAre());
    ASSERT_THAT(asked(), ElementsAre(Kind::Jog));
    ASSERT_EQ(requests[0].jogs.size(), 2u);
    EXPECT_NEAR(requests[0].jogs[0].speed_mm_s, 6, 1e-9);
    EXPECT_NEAR(requests[0].jogs[1].speed_mm_s, 8, 1e-9);
    EXPECT_NEAR(requests[0].jogs[1].distance_mm.value(), 4, 1e-9);
    grbl.answer(requests[0].number, {.is_done = true});
    change(MachinePhase::Jogging);
    EXPECT_THAT(lines(), ElementsAre("ok"));
    EXPECT_THAT(send("$J=X1 F100\n"), ElementsAre()) << "it waits for the first one";
    EXPECT_THAT(send("\x85"), ElementsAre("ok"));
    EXPECT_THAT(asked(), ElementsAre(Kind::CancelJog));
    EXPECT_THAT(send("G0 X1\n"), ElementsAre("[MSG:a jog is in progress]", "error:9"));
    grbl.end_jog();
    change(MachinePhase::Idle);
    EXPECT_THAT(send("\x85"), ElementsAre());
    EXPECT_THAT(asked(), ElementsAre());
}

TEST_F(Sender, HasTheNextJogBeginWhenTheOneBeforeIsOver) {
    (void)send("$J=G91 X1 F100\n$J=G91 X1 F100\n$G\n");
    ASSERT_THAT(asked(), ElementsAre(Kind::Jog));
    grbl.answer(requests[0].number, {.is_done = true});
    change(MachinePhase::Jogging);
    EXPECT_THAT(asked(), ElementsAre());
    change(MachinePhase::Idle);
    grbl.end_jog();
    ASSERT_THAT(asked(), ElementsAre(Kind::Jog));
    grbl.answer(requests[0].number, {.why = FaultCode::Busy, .text = "busy"});
    EXPECT_THAT(lines(), ElementsAre("ok", "[MSG:busy]", "error:9", StartsWith("[GC:"), "ok"));
}

TEST_F(Sender, HasWrongJogsRefusedByGrblsNumbers) {
    EXPECT_THAT(send("$J\n"), testing::Contains("error:16"));
    EXPECT_THAT(send("$J=X1\n"), testing::Contains("error:22"));
    EXPECT_THAT(send("$J=F100\n"), testing::Contains("error:26"));
    EXPECT_THAT(send("$J=X201F100\n"), testing::Contains("error:15"));
    EXPECT_THAT(send("$J=G91X-11F100\n"), testing::Contains("error:15"));
    EXPECT_THAT(send("$J=G1X1F100\n"), testing::Contains("error:16"));
    EXPECT_THAT(send("$J=A1F100\n"), testing::Contains("error:16"));
    EXPECT_THAT(send("$J=M3X1F100\n"), testing::Contains("error:16"));
    EXPECT_THAT(send("$J=X1X2F100\n"), testing::Contains("error:25"));
    EXPECT_THAT(send("$J=XF100\n"), testing::Contains("error:2"));
    EXPECT_THAT(send("$J=1F100\n"), testing::Contains("error:1"));
    EXPECT_THAT(send("$J=X10F100\n"), ElementsAre("ok")) << "it stands there";
    EXPECT_THAT(asked(), ElementsAre());
    change(MachinePhase::Running);
    EXPECT_THAT(send("$J=X1F100\n"), ElementsAre("error:8"));
}

TEST_F(Sender, JogsInWorkCoordinatesInchesAndAtMostAtFullSpeed) {
    view.values.systems[0].origin = {100, 0, 0};
    grbl.see(view);
    (void)send("$J=G20 X1 F10000\n");
    ASSERT_THAT(asked(), ElementsAre(Kind::Jog));
    EXPECT_NEAR(requests[0].jogs[0].distance_mm.value(), 115.4, 1e-9);
    EXPECT_NEAR(requests[0].jogs[0].speed_mm_s, 50, 1e-9);
    EXPECT_THAT(send("$G\n"), ElementsAre()) << "the jog is not answered yet";
    grbl.answer(requests[0].number, {.is_done = true});
    EXPECT_THAT(lines()[1], HasSubstr("G21")) << "it changes no mode";
}

TEST_F(Sender, SeesAJogFromItsAnswerToItsEnd) {
    (void)send("$J=G91 X1 F100\n");
    ASSERT_THAT(asked(), ElementsAre(Kind::Jog));
    grbl.answer(requests[0].number, {.is_done = true});
    EXPECT_THAT(status(), StartsWith("<Jog|")) << "though the machine's state does not show it yet";
    view.axes[0].at_rest = false;
    grbl.see(view);
    grbl.end_jog();
    (void)lines();
    EXPECT_THAT(status(), StartsWith("<Run|")) << "where an axis stands is not known yet";
}

TEST_F(Sender, HomesAllAxesOrOne) {
    EXPECT_THAT(send("$H\n$G\n"), ElementsAre());
    ASSERT_THAT(asked(), ElementsAre(Kind::Home));
    EXPECT_TRUE(requests[0].axes.empty());
    change(MachinePhase::Homing);
    EXPECT_THAT(status(), StartsWith("<Home|"));
    change(MachinePhase::Idle);
    grbl.answer(requests[0].number, {.is_done = true});
    EXPECT_THAT(lines(), ElementsAre("ok", StartsWith("[GC:"), "ok"));
    (void)send("$HY\n");
    ASSERT_THAT(asked(), ElementsAre(Kind::Home));
    EXPECT_EQ(requests[0].axes, AxisSet{AxisIndex{1}});
    grbl.answer(requests[0].number, {.why = FaultCode::HomeSwitchNotFound, .text = "no switch"});
    EXPECT_THAT(lines(), ElementsAre("[MSG:no switch]", "error:9"));
    EXPECT_THAT(send("$HQ\n"), testing::Contains("error:3"));
}

TEST_F(Sender, IsToldOfAFaultOnceAndUnlocksIt) {
    change(MachinePhase::Fault, FaultCode::LimitHit);
    EXPECT_THAT(lines(), ElementsAre("ALARM:1", AllOf(HasSubstr("limit-hit"), HasSubstr("then: $X, $H"))));
    change(MachinePhase::Fault, FaultCode::LimitHit);
    EXPECT_THAT(lines(), ElementsAre());
    EXPECT_THAT(send("G0 X1\n"), ElementsAre("error:9"));
    EXPECT_THAT(send("$X\n"), ElementsAre());
    ASSERT_THAT(asked(), ElementsAre(Kind::Reset));
    grbl.answer(requests[0].number, {.is_done = true});
    EXPECT_THAT(lines(), ElementsAre("[MSG:Caution: Unlocked]", "ok"));
    view.axes[0].homed = false;
    change(MachinePhase::Idle);
    EXPECT_THAT(status(), StartsWith("<Idle|")) << "unlocked";
}

TEST_F(Sender, SleepsUntilAReset) {
    EXPECT_THAT(send("$SLP\n"), ElementsAre("[MSG:Sleeping]", "ok"));
    EXPECT_THAT(status(), StartsWith("<Sleep|"));
    EXPECT_THAT(send("G0 X1\n"), ElementsAre("error:9"));
    (void)send("\x18");
    EXPECT_THAT(status(), StartsWith("<Idle|"));
}

TEST_F(Sender, LosesItsLinesWithASoftReset) {
    (void)send("G1 X12 F100\n$G\n$G");
    asked();
    const std::uint64_t given_up = requests[0].number;
    EXPECT_THAT(send("\x18"), ElementsAre("", StartsWith("Grbl")));
    grbl.answer(given_up, {.is_done = true});
    EXPECT_THAT(lines(), ElementsAre()) << "its answer is of no interest any more";
    EXPECT_THAT(send("\n"), ElementsAre("ok"));
}

TEST_F(Sender, LineOfAMegabyteIsRefusedOnce) {
    EXPECT_THAT(send(std::string(1'000'000, 'G')), ElementsAre());
    EXPECT_THAT(send("\n$G\n"), ElementsAre("error:11", StartsWith("[GC:"), "ok"));
}

TEST_F(Sender, GetsOneAnswerPerLineIfLinesOverflow) {
    EXPECT_THAT(send("G1 X12 F100\n"), ElementsAre());
    for (int i = 0; i < 10'000; ++i) { grbl.receive("G0\n"); }
    asked();
    grbl.answer(requests[0].number, {.is_done = true});
    const auto found = lines();
    EXPECT_LE(found.size(), 4097u);
    EXPECT_THAT(send("$G\n"), ElementsAre(StartsWith("[GC:"), "ok")) << "there is room again";
}

/// With any bytes in any state every line ends, memory is bounded, and a plain line is answered afterwards.
TEST_F(Sender, OfGarbageDoesNoHarm) {
    std::mt19937 random(1);
    constexpr std::string_view kUsual = "$#GIXCHJ=NRSTLP0123456789.-+XYZFGM?!~\x18\x85\n\r ()%;*";
    for (int i = 0; i < 20'000; ++i) {
        std::string bytes;
        for (auto n = random() % 40; n > 0; --n) {
            bytes += random() % 4 == 0 ? static_cast<char>(random()) : kUsual[random() % kUsual.size()];
        }
        (void)send(bytes);
        (void)asked();
        for (const Request& request : requests) {
            if (random() % 2 == 0) { grbl.answer(request.number, {.is_done = random() % 2 == 0}); }
        }
        if (random() % 5 == 0) { grbl.end_jog(); }
        if (random() % 9 == 0) { change(static_cast<MachinePhase>(random() % 10), FaultCode::DeviceLost); }
    }
    change(MachinePhase::Idle);
    (void)send("\x18");
    grbl.end_jog();
    (void)lines();
    EXPECT_THAT(send("$I\n"), ElementsAre(StartsWith("[VER:"), StartsWith("[OPT:"), "ok"));
}

}  // namespace
}  // namespace lockstep::grbl
