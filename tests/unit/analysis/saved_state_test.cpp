// A saved state is taken where it belongs and is whole, and refused everywhere else.
#include "framework/analysis/simulate/saved_state.h"
#include "framework/integration/integrator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <string>

#include <nlohmann/json.hpp>

#include "framework/analysis/simulate/identity.h"
#include "framework/build/build.h"
#include "framework/common/sha256.h"
#include "framework/common/archive.h"
#include "tests/scenes/flexible/flexible_scenes.h"
#include "tests/refusal.h"

namespace pintle_scenes::saved_state_test {
namespace {

using pintle_test::says;

namespace fs = std::filesystem;
using namespace pintle;

// The examples of FIPS 180-4 and of NIST's CAVP.
TEST(Sha256, MeetsThePublishedExamples) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256("abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmnhijklmnoijklmnopjklmnopqklmnopqrlmnopqrsmnopqrstnopqrstu"),
            "cf5b16a778af8380036ce59e7b0492370b249b11e8f07a51afac45037afee9d1");
  EXPECT_EQ(sha256(std::string(1'000'000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, DoesNotDependOnHowTheTextIsCut) {
  std::string text;
  for (int i = 0; i < 300; ++i) text += static_cast<char>(i * 7);
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    Sha256 sum;
    sum.add(text.substr(0, cut));
    sum.add(text.substr(cut));
    ASSERT_EQ(sum.hex(), sha256(text)) << cut;
  }
}

TEST(Layout, ChangesWithNamesOrderAndSizes) {
  EXPECT_NE((layout<double, double>("a, b")), (layout<double, double>("b, a")));
  EXPECT_NE((layout<double, double>("a, b")), (layout<double, double, double>("a, b, c")));
  EXPECT_NE((layout<double, float>("a, b")), (layout<double, double>("a, b")));
  EXPECT_NE((layout<double, long>("a, b")), (layout<double, double>("a, b")));
}

/// A run and the state at its end.
struct Ran {
  Scene scene;
  Model model;
  Assembly assembly;
  SavedState state;
  explicit Ran(Scene s) : scene(std::move(s)), model(build(scene)), assembly(assemble(scene, model)) {
    Listeners listeners;
    listeners.state = [&](const SavedState& at) { state = at; };
    const pintle::Run run = simulate(scene, model, assembly, listeners);
    EXPECT_NE(run.status, Status::failed) << run.reason;
  }
  std::string text() const { return state_text(identity(scene, model, assembly), state); }
  SavedState read(const std::string& text) const { return state_of(text, "x.state", scene, model, assembly); }
};

/// Why a text is refused.
std::string refusal(const Ran& ran, const std::string& text) {
  return pintle_test::refusal_by([&] { ran.read(text); });
}

std::string sealed(const std::string& text) { return text + "\nchecksum " + sha256(text) + "\n"; }
std::string unsealed(const std::string& text) { return text.substr(0, text.rfind("\nchecksum ")); }

Scene swinging() {
  Scene s = pendulum(Hanging::by_pin, 0.5);
  s.run.until = 0.05, s.run.method = "dopri5";
  return s;
}
Scene striking(const std::string& method) {
  return scene({.clearance = 1e-4,
                .until = 0.01,
                .tolerance = 1e-6,
                .method = method,
                .constraints = method == "rkf45" ? "partitioning" : "projection"});
}

TEST(SavedState, ComesBackToTheBit) {
  for (const char* method : {"dopri5", "rkf45", "generalized-alpha"}) {
    const Ran ran(striking(method));
    const SavedState back = ran.read(ran.text());
    EXPECT_EQ(back.t, ran.state.t);
    EXPECT_EQ(back.memory, ran.state.memory);
    EXPECT_EQ(back.first.kinetic, ran.state.first.kinetic);
    EXPECT_EQ(back.energy_in_play, ran.state.energy_in_play);
    EXPECT_EQ(back.worst_unexplained, ran.state.worst_unexplained);
  }
}

TEST(SavedState, RefusesEveryFlippedBit) {
  const Ran ran(swinging());
  std::string text = ran.text();
  for (std::size_t i = 0; i < text.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      text[i] = static_cast<char>(text[i] ^ (1 << bit));
      ASSERT_TRUE(says(refusal(ran, text), "x.state: ")) << "byte " << i << ", bit " << bit;
      text[i] = static_cast<char>(text[i] ^ (1 << bit));
    }
  EXPECT_EQ(refusal(ran, text), "accepted");
}

TEST(SavedState, RefusesEveryCutAndWhatIsAdded) {
  const Ran ran(swinging());
  const std::string text = ran.text();
  for (std::size_t n = 0; n < text.size(); ++n) {
    ASSERT_NE(refusal(ran, text.substr(0, n)), "") << n;
    if (n > 0) {
      ASSERT_NE(refusal(ran, text.substr(n)), "") << n;
    }
  }
  for (const char* more : {"\n", " ", "x", "\nchecksum "}) EXPECT_NE(refusal(ran, text + more), "");
  EXPECT_NE(refusal(ran, text + text), "");
}

// With a checksum that is right: what is no number of this system is refused, what is one may be gone on from.
TEST(SavedState, AForgedOneNeverReadsOutOfBounds) {
  for (const char* method : {"dopri5", "rkf45", "generalized-alpha"}) {
    const Ran ran(striking(method));
    const std::string whole = unsealed(ran.text());
    const std::size_t memory = whole.find("\nmemory ");
    int rejected = 0, taken = 0;
    for (std::size_t i = 0; i < whole.size(); i += i < memory ? 1 : 3)
      for (const int flip : {1, 0x80, 0xff}) {
        std::string text = whole;
        text[i] = static_cast<char>(text[i] ^ flip);
        if (refusal(ran, sealed(text)) != "accepted") {
          ++rejected;
          continue;
        }
        ++taken;
        Integrator run(ran.model.system, ran.model.scheme, ran.assembly.start);
        run.load(ran.read(sealed(text)).memory);
        for (int k = 0; k < 2 && run.advance(1); ++k) continue;
      }
    EXPECT_GT(rejected, 100) << method;
    EXPECT_GT(taken, 100) << method;
  }
}

TEST(SavedState, AForgedOneOfAnotherSizeIsRefused) {
  for (const char* method : {"dopri5", "generalized-alpha"}) {
    const Ran ran(striking(method));
    for (std::size_t n = 0; n < ran.state.memory.size(); n += 5) {
      SavedState less = ran.state, more = ran.state;
      less.memory.resize(n);
      more.memory.insert(n, 8, '\0');
      const std::string who = identity(ran.scene, ran.model, ran.assembly);
      ASSERT_NE(refusal(ran, state_text(who, less)), "") << n;
      if (const std::string why = refusal(ran, state_text(who, more)); n % 8 == 0) {
        ASSERT_NE(why, "") << n;
      }
    }
  }
}

TEST(SavedState, RefusesAnotherLayoutOfWhatIsSaved) {
  const Ran ran(swinging());
  SavedState other = ran.state;
  other.memory[0] = static_cast<char>(other.memory[0] ^ 1);
  EXPECT_TRUE(says(refusal(ran, state_text(identity(ran.scene, ran.model, ran.assembly), other)), "another layout"));
}

TEST(SavedState, RefusesAnotherVersion) {
  const Ran ran(swinging());
  std::string text = unsealed(ran.text());
  const std::size_t at = text.find("version ") + 8;
  text[at] = static_cast<char>(text[at] + 1);
  EXPECT_TRUE(says(refusal(ran, sealed(text)), "was saved by pintle"));
  EXPECT_TRUE(says(refusal(ran, "pintle state 1\n" + text.substr(text.find('\n') + 1)), "another version"));
  EXPECT_TRUE(says(refusal(ran, "t [s],x\n0,1\n"), "is not a saved state"));
}

TEST(SavedState, RefusesBooksThatAreNoEnergies) {
  const Ran ran(swinging());
  const std::string who = identity(ran.scene, ran.model, ran.assembly);
  for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (double SavedState::*member : {&SavedState::energy_in_play, &SavedState::worst_unexplained, &SavedState::t}) {
      SavedState state = ran.state;
      state.*member = wrong;
      EXPECT_NE(refusal(ran, state_text(who, state)), "");
    }
  SavedState negative = ran.state;
  negative.energy_in_play = -1;
  EXPECT_TRUE(says(refusal(ran, state_text(who, negative)), "negative time or energy"));
}

TEST(SavedState, RefusesAnotherSceneMadeInCpp) {
  const Ran ran(striking("dopri5"));
  const std::string text = ran.text();
  const auto changed = [&](const std::function<void(Scene&)>& change) {
    Scene other = ran.scene;
    change(other);
    const Model model = build(other);
    const Assembly assembly = assemble(other, model);
    return says(pintle_test::refusal_by([&] { state_of(text, "x.state", other, model, assembly); }), "another scene");
  };
  EXPECT_FALSE(changed([](Scene&) {}));
  EXPECT_TRUE(changed([](Scene& s) { s.bodies[1].mass *= 1 + 1e-15; }));
  EXPECT_TRUE(changed([](Scene& s) { s.gravity[1] *= 2; }));
  EXPECT_TRUE(changed([](Scene& s) { s.joints[2].clearance->radial *= 1.01; }));
  EXPECT_TRUE(changed([](Scene& s) { s.joints[2].clearance->normal.restitution = 0.7; }));
  EXPECT_TRUE(changed([](Scene& s) { s.run.tolerance *= 2; }));
  EXPECT_TRUE(changed([](Scene& s) { s.start_bodies[0].speed = 149; }));
  EXPECT_TRUE(changed(
      [](Scene& s) { s.bodies[0].name += "shaft", s.joints[0].b.body = s.joints[1].a.body = s.start_bodies[0].body = s.bodies[0].name; }));
}

TEST(SavedState, RefusesAnotherLawMadeInCpp) {
  Scene s = swinging();
  s.loads = {torque("push", "bob", wave(0, 1, 10))};
  const Ran ran(s);
  const std::string text = ran.text();
  s.loads = {torque("push", "bob", wave(0, 1, 10.001))};
  const Ran other(s);
  EXPECT_EQ(refusal(ran, text), "accepted");
  EXPECT_TRUE(says(refusal(other, text), "another scene"));
}

// Laws of signals that differ only early in a run, or only for small signals.
TEST(SavedState, RefusesAnotherLawOfSignalsMadeInCpp) {
  const auto pushed = [](const SignalFunction& law) {
    Scene s = swinging();
    s.loads = {
        torque("push", "bob",
               {.at = {}, .text = "made in C++", .constant = false, .of_signals = law, .signals = {"bob.speed"}, .uses_time = true})};
    return Ran(s);
  };
  const auto brake = [](double early, double slow) {
    return [=](double t, const double* in, double* slope) {
      const double c = (t > 0 && t < 1e-3 ? early : 1) * (in[0] < 0 && in[0] > -1e-2 ? slow : 1);
      if (slope) slope[0] = -1e-3 * c;
      return -1e-3 * c * in[0];
    };
  };
  const Ran ran = pushed(brake(1, 1));
  const std::string text = ran.text();
  EXPECT_EQ(refusal(pushed(brake(1, 1)), text), "accepted");
  EXPECT_TRUE(says(refusal(pushed(brake(2, 1)), text), "another scene"));
  EXPECT_TRUE(says(refusal(pushed(brake(1, 2)), text), "another scene"));
}

TEST(SavedState, IsTakenWithAnotherTitleEndAndOutput) {
  Scene s = striking("auto");
  const Ran ran(s);
  s.title = "another", s.run.until = 3, s.output.every = 1e-3, s.output.frames = 5;
  const Ran longer([&] {
    Scene brief = s;
    brief.run.until = 0.011;
    return brief;
  }());
  EXPECT_EQ(refusal(longer, ran.text()), "accepted");
}

std::string driven(const std::string& more) {
  return "bodies: {rod: {rigid: {mass: 1, inertia: 0.1}, points: {O: [-0.2, 0]}}}\n"
         "joints: {hinge: {revolute: [ground, rod.O]}}\n"
         "drivers: {motor: {angle: [ground, rod], law: {table: saved_state_motion.csv}}}\n"
         "run: {until: 0.2, method: dopri5}\n" +
         more;
}

TEST(SavedState, RefusesAChangedTable) {
  const fs::path table = fs::path(testing::TempDir()) / "saved_state_motion.csv";
  const auto write = [&](int changed) {
    std::ofstream out(table);
    out.precision(12);
    for (int i = 0; i <= 1000; ++i) out << 1e-3 * i << ", " << 1e-3 * i + (i == changed ? 1e-9 : 0) << "\n";
  };
  write(-1);
  const Ran ran(scene_of(driven("")));
  const std::string text = ran.text();
  const Ran same(scene_of(driven("output: {every: 0.01}\ntitle: another\n")));
  EXPECT_EQ(refusal(same, text), "accepted");
  for (const int row : {500, 777, 1000}) {  // all after the state
    write(row);
    const Ran other(scene_of(driven("")));
    EXPECT_TRUE(says(refusal(other, text), "has changed since: saved_state_motion.csv")) << row << ": " << refusal(other, text);
  }
  fs::remove(table);
}

TEST(SavedState, NamesTheEntriesOfTheSceneThatAreOthers) {
  const auto rod = [](const std::string& mass, const std::string& tolerance) {
    return Ran(scene_of("bodies: {rod: {rigid: {mass: " + mass +
                        ", inertia: 0.1}, points: {O: [-0.2, 0]}}}\njoints: {hinge: {revolute: [ground, rod.O]}}\n"
                        "run: {until: 0.1, method: dopri5, tolerance: " +
                        tolerance + "}\n"));
  };
  const std::string text = rod("1", "1e-6").text();
  const std::string mass = refusal(rod("2", "1e-6"), text), both = refusal(rod("2", "1e-7"), text);
  EXPECT_TRUE(says(mass, "bodies.rod differs") && !says(mass, "run.tolerance")) << mass;
  EXPECT_TRUE(says(both, "bodies.rod and run.tolerance differ") && says(both, "--set")) << both;
}

// Of a mechanism with other numbers but the same words and files, what made them is named.
TEST(SavedState, NamesTheProgramAndTheBlasThatMadeOtherNumbers) {
  const Ran ran(swinging());
  const std::string here = identity(ran.scene, ran.model, ran.assembly);
  const auto there = [&](const char* part, const std::string& value) {
    nlohmann::json all = nlohmann::json::parse(here);
    all["mechanism"] = "0", all[part] = value;
    return difference(all.dump(), here);
  };
  EXPECT_EQ(difference(here, here), "");
  const std::string blas = there("blas", "Cray, 7 threads"), program = there("program", "0.0.1, compiled by hand");
  EXPECT_TRUE(says(blas, "Cray, 7 threads") && says(blas, "OPENBLAS_NUM_THREADS") && !says(blas, "another scene")) << blas;
  EXPECT_TRUE(says(program, "0.0.1, compiled by hand") && !says(program, "BLAS is")) << program;
}

TEST(SavedState, RefusesAChangedMesh) {
  FlexibleCrank o;
  o.coupler = holed_plate("{frame: chord, count: 2}");
  o.until = 1e-3, o.tolerance = 1e-6, o.points = "coupler.A";
  const Ran ran(scene_of(text(o)));
  const std::string saved = ran.text();
  EXPECT_EQ(refusal(ran, saved), "accepted");
  const fs::path mesh = fs::path(testing::TempDir()) / "pintle_holed_plate_RefusesAChangedMesh.inp";
  std::ifstream in(mesh);
  std::string all((std::istreambuf_iterator<char>(in)), {});
  const std::size_t at = all.find("\n1, ");
  ASSERT_NE(at, std::string::npos);
  all.replace(at, all.find('\n', at + 1) - at, "\n1, -0.0449, -0.015");
  std::ofstream(mesh) << all;
  const Ran other(scene_of(text(o)));
  EXPECT_TRUE(says(refusal(other, saved), "has changed since: pintle_holed_plate_RefusesAChangedMesh.inp")) << refusal(other, saved);
}

TEST(SavedState, ARunThatGoesOnSaysWhatItHasNotSeen) {
  for (const bool linked : {false, true}) {
    Scene s = striking("dopri5");
    if (linked) s.joints[2].clearance->model = ClearanceModel::massless_link, s.start_journals[0].eccentricity = {1e-4, 0};
    Ran ran(s);
    ran.scene.run.until = 0.011;
    const pintle::Run rest = simulate(ran.scene, ran.model, ran.assembly, {}, &ran.state);
    EXPECT_NE(rest.status, Status::failed) << rest.reason;
    EXPECT_EQ(std::ranges::count_if(rest.warnings, [](const std::string& w) { return says(w, "this run continues from 0.01 s"); }),
              linked ? 1 : 0);
  }
}

TEST(SavedState, RefusesWhatCannotBeRead) {
  const Ran ran(swinging());
  const fs::path folder = fs::path(testing::TempDir()) / "saved_state_folder";
  fs::create_directories(folder);
  std::ofstream(folder / "empty.state").close();
  for (const fs::path& file : {folder, folder / "none.state", folder / "empty.state"})
    EXPECT_THROW(read_state(file, ran.scene, ran.model, ran.assembly), SceneError) << file;
  std::ofstream(folder / "good.state", std::ios::binary) << ran.text();
  EXPECT_EQ(read_state(folder / "good.state", ran.scene, ran.model, ran.assembly).memory, ran.state.memory);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace pintle_scenes::saved_state_test
