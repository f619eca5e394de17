#include "meshes/inp_claims.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

namespace pintle {

namespace {

enum class Meaning {
  none,   ///< not part of the body: output, steps
  model,  ///< read elsewhere, or below
  load,   ///< supports and loads
  law,    ///< of a material, other than linear elasticity
  axes,   ///< of a material
  contact,
  spider,  ///< couples the nodes of a rim to a reference node
  part,    ///< changes the body: rejected
};

struct Keyword {
  Meaning meaning;
  std::vector<std::string_view> names;
};
const std::vector<Keyword>& keywords() {
  static const std::vector<Keyword> all{
      {Meaning::model,
       {"NODE", "ELEMENT", "NSET", "ELSET", "SURFACE", "PART", "INSTANCE", "MATERIAL", "ELASTIC", "DENSITY", "SOLID SECTION",
        "SHELL SECTION", "MEMBRANE SECTION", "BEAM SECTION", "BEAM GENERAL SECTION", "FRAME SECTION"}},
      {Meaning::none,
       {"HEADING",
        "PREPRINT",
        "END PART",
        "END INSTANCE",
        "ASSEMBLY",
        "END ASSEMBLY",
        "STEP",
        "END STEP",
        "NODE PRINT",
        "NODE FILE",
        "NODE OUTPUT",
        "EL PRINT",
        "EL FILE",
        "ELEMENT OUTPUT",
        "OUTPUT",
        "CONTACT PRINT",
        "CONTACT FILE",
        "CONTACT OUTPUT",
        "ENERGY PRINT",
        "ENERGY FILE",
        "ENERGY OUTPUT",
        "SECTION PRINT",
        "SECTION FILE",
        "MODAL FILE",
        "MODAL OUTPUT",
        "MONITOR",
        "RESTART",
        "FILE FORMAT",
        "PRINT",
        "TIME POINTS",
        "FILTER",
        "PHYSICAL CONSTANTS",
        "STATIC",
        "FREQUENCY",
        "DYNAMIC",
        "MODAL DYNAMIC",
        "STEADY STATE DYNAMICS",
        "COMPLEX FREQUENCY",
        "BUCKLE",
        "VISCO",
        "HEAT TRANSFER",
        "COUPLED TEMPERATURE-DISPLACEMENT",
        "UNCOUPLED TEMPERATURE-DISPLACEMENT",
        "RANDOM RESPONSE",
        "RESPONSE SPECTRUM",
        "NO ANALYSIS",
        "GREEN",
        "SENSITIVITY",
        "AMPLITUDE",
        "CONTROLS",
        "SOLVER",
        "SOLUTION TECHNIQUE",
        "EXPANSION",
        "CONDUCTIVITY",
        "SPECIFIC HEAT",
        "SELECT CYCLIC SYMMETRY MODES",
        "OUTPUT HISTORY",
        "CFLUX",
        "DFLUX",
        "FILM",
        "RADIATE",
        "CHANGE MATERIAL",
        "HOURGLASS STIFFNESS",
        "SECTION CONTROLS",
        "TRANSVERSE SHEAR STIFFNESS",
        "DISTRIBUTION TABLE"}},
      {Meaning::load,
       {"BOUNDARY", "CLOAD", "DLOAD", "DSLOAD", "TEMPERATURE", "INITIAL CONDITIONS", "BASE MOTION", "TRANSFORM", "FIELD",
        "PREDEFINED FIELD", "INERTIA RELIEF", "BOUNDARY CHANGE", "LOAD CASE", "END LOAD CASE", "CONNECTOR MOTION", "CONNECTOR LOAD",
        "MODAL DAMPING"}},
      {Meaning::law,
       {"PLASTIC",
        "CYCLIC HARDENING",
        "CREEP",
        "HYPERELASTIC",
        "HYPERFOAM",
        "VISCOELASTIC",
        "DAMPING",
        "USER MATERIAL",
        "DEPVAR",
        "DEFORMATION PLASTICITY",
        "MOHR COULOMB",
        "DRUCKER PRAGER",
        "CONCRETE",
        "DAMAGE INITIATION",
        "DAMAGE EVOLUTION",
        "RATE DEPENDENT",
        "NO COMPRESSION",
        "NO TENSION",
        "FAIL STRESS",
        "FAIL STRAIN"}},
      {Meaning::axes, {"ORIENTATION", "DISTRIBUTION"}},
      {Meaning::contact,
       {"CONTACT", "CONTACT PAIR", "CONTACT INCLUSIONS", "CONTACT EXCLUSIONS", "CONTACT PROPERTY ASSIGNMENT", "CONTACT DAMPING",
        "CLEARANCE", "SURFACE INTERACTION", "SURFACE BEHAVIOR", "FRICTION", "GAP CONDUCTANCE", "CONTACT CONTROLS", "CHANGE FRICTION"}},
      {Meaning::spider, {"COUPLING", "KINEMATIC", "DISTRIBUTING", "KINEMATIC COUPLING", "DISTRIBUTING COUPLING"}},
      {Meaning::part,
       {"EQUATION",
        "MPC",
        "NODAL THICKNESS",
        "TIE",
        "EMBEDDED ELEMENT",
        "EMBEDDED REGION",
        "SHELL TO SOLID COUPLING",
        "CYCLIC SYMMETRY MODEL",
        "PRE-TENSION SECTION",
        "SUBMODEL",
        "SUBSTRUCTURE PROPERTY",
        "SUPER ELEMENT",
        "MATRIX INPUT",
        "MATRIX ASSEMBLE",
        "FASTENER",
        "CONNECTOR SECTION",
        "SPRING",
        "DASHPOT",
        "GAP",
        "MASS",
        "ROTARY INERTIA",
        "NONSTRUCTURAL MASS",
        "IMPERFECTION",
        "MODEL CHANGE",
        "RELEASE",
        "COHESIVE SECTION",
        "GASKET SECTION",
        "REBAR",
        "REBAR LAYER",
        "USER ELEMENT",
        "DISPLAY BODY",
        "RETAINED NODAL DOFS",
        "MULTI-POINT"}},
  };
  return all;
}

struct Reading {
  const InpDeck& queue;
  const InpElements& elements;
  InpClaims claims{};
  std::map<Meaning, std::vector<std::string>> seen{};  ///< "*CLOAD of line 12", each keyword once
  std::set<std::string> named{};                       ///< keywords in `seen`
  std::map<std::string, std::string> section_of{};     ///< material of sections, and where it is first named

  const std::string& file(InpPlace p) const { return name_[static_cast<std::size_t>(p.file)]; }
  std::string where(InpPlace p) const { return file(p) + ":" + std::to_string(p.line); }

  explicit Reading(const InpDeck& d, const InpElements& e) : queue(d), elements(e) {
    for (const auto& path : d.text.files) name_.push_back(path.filename().string());
  }

  static Meaning meaning(const InpCard& card) {
    if (card.keyword == "RIGID BODY") return card.find("ELSET") ? Meaning::part : Meaning::spider;
    for (const Keyword& k : keywords())
      if (std::find(k.names.begin(), k.names.end(), card.keyword) != k.names.end()) return k.meaning;
    return Meaning::none;
  }
  static bool known(const InpCard& card) {
    if (card.keyword == "RIGID BODY" || card.keyword.empty()) return true;
    return std::any_of(keywords().begin(), keywords().end(),
                       [&](const Keyword& k) { return std::find(k.names.begin(), k.names.end(), card.keyword) != k.names.end(); });
  }

  [[noreturn]] void reject_part(const InpCard& card) const {
    const bool ties = card.keyword == "TIE" || card.keyword == "EQUATION" || card.keyword == "MPC" || card.keyword.starts_with("EMBEDDED");
    queue.text.reject(
        card.place, "*", card.keyword,
        ties ? " ties nodes to each other, which is not supported: the body would come apart there. Mesh the parts with shared nodes"
             : " adds something other than plane elements to the body, which is not supported: describe it in the scene (lumps, joints, "
               "forces, points of holes) and remove it here");
  }

  std::vector<double> numbers(const InpDeck::Other& other) const {
    std::vector<double> out;
    if (other.first == other.last) return out;
    std::string_view rest = queue.text.lines[other.first].text, field;
    for (double value = 0; next_field(rest, field) && to_number(field, value);) out.push_back(value);
    return out;
  }

  void say(const std::string& what) { claims.warnings.push_back(what); }

  void section(const InpDeck::Other& other) {
    const InpCard& card = other.card;
    const std::string* set = card.find("ELSET");
    const std::string* material = card.find("MATERIAL");
    if (material) section_of.try_emplace(upper(*material), *material + " (" + where(card.place) + ")");
    for (const char* word : {"COMPOSITE", "NODAL THICKNESS", "OFFSET"})
      if (card.find(word))
        say(where(card.place) + ": " + word + " of *" + card.keyword +
            " is ignored; the body has one thickness and one layer, those of the scene");
    if (card.find("ORIENTATION")) seen_once(Meaning::axes, "ORIENTATION of *" + card.keyword, card.place);
    const std::vector<int> members = set ? elements.of_set(*set) : std::vector<int>{};
    const bool lines = !members.empty() && std::all_of(members.begin(), members.end(), [&](int e) { return !plane(e); });
    if (lines && has_plane())
      queue.text.reject(card.place, "*", card.keyword, " makes the ", members.size(), " line elements of \"", *set,
                        "\" separate bars or beams in addition to the plane elements; from such a file only plane elements are read: "
                        "remove the lines, mesh them as plane elements, or make them bodies of the scene");
    const bool thick = card.keyword == "SOLID SECTION" || card.keyword == "SHELL SECTION" || card.keyword == "MEMBRANE SECTION";
    if (!thick || lines || card.find("COMPOSITE")) return;
    if (const std::vector<double> data = numbers(other); !data.empty()) claims.thickness.push_back({data[0], where(card.place)});
  }

  bool plane(int e) const { return corners_of(queue.elements[static_cast<std::size_t>(e)].kind.shape) > 2; }
  bool has_plane() const {
    return std::any_of(queue.elements.begin(), queue.elements.end(),
                       [](const InpDeck::Element& e) { return corners_of(e.kind.shape) > 2; });
  }

  void seen_once(Meaning what, const std::string& keyword, InpPlace place) {
    if (named.insert(keyword).second) seen[what].push_back(keyword + " (" + where(place) + ")");
  }

  // The material named by the sections, or the only one.
  void materials() {
    std::string current;
    for (const InpDeck::Other& other : queue.others) {
      const InpCard& card = other.card;
      if (card.keyword == "MATERIAL") current = card.find("NAME") ? upper(*card.find("NAME")) : "";
      if (card.keyword != "ELASTIC" || (!section_of.empty() && !section_of.contains(current))) continue;
      const std::string* type = card.find("TYPE");
      const std::string kind = type ? upper(*type) : "ISOTROPIC";
      if (kind != "ISOTROPIC" && kind != "ISO") {
        claims.directional = where(card.place);
        continue;
      }
      const std::vector<double> data = numbers(other);
      if (!data.empty()) claims.young.push_back({data[0], where(card.place)});
      if (data.size() > 1) claims.poisson.push_back({data[1], where(card.place)});
    }
    if (section_of.size() < 2) return;
    std::string list;
    for (const auto& [key, at] : section_of) list += (list.empty() ? "" : ", ") + at;
    say("the sections of the file name " + std::to_string(section_of.size()) + " materials, " + list +
        "; the material of the scene is used for the whole body");
  }

  void strain() {
    const InpDeck::Element *strained = nullptr, *stressed = nullptr;
    for (const InpDeck::Element& e : queue.elements) {
      if (corners_of(e.kind.shape) < 3) continue;
      const InpDeck::Element*& first = e.kind.strain ? strained : stressed;
      if (!first) first = &e;
    }
    if (strained && stressed)
      queue.text.reject(strained->place, "this element is for plane strain (CPE), but the one on line ", stressed->place.line,
                        " is not; a body has one kind only: make all elements CPS or all CPE");
    if (strained) claims.strain = where(strained->place);
  }

  void lines() {
    if (!has_plane()) return;
    int count = 0, first = -1;
    for (std::size_t e = 0; e < queue.elements.size(); ++e)
      if (!plane(static_cast<int>(e)) && !elements.along_side(static_cast<int>(e)) && count++ == 0) first = static_cast<int>(e);
    if (count > 0)
      say(where(queue.elements[static_cast<std::size_t>(first)].place) + ": element " +
          std::to_string(queue.element_numbers[static_cast<std::size_t>(first)]) +
          " is a line that is not along a side of a plane element; it is ignored" +
          (count > 1 ? ", and so are " + std::to_string(count - 1) + " more" : "") + "; make bars and beams a separate body");
  }

  void tell(Meaning what, const std::string& rest) {
    const auto found = seen.find(what);
    if (found == seen.end()) return;
    std::string list;
    for (std::size_t k = 0; k < found->second.size(); ++k)
      list += (k == 0 ? "" : k + 1 == found->second.size() ? " and " : ", ") + found->second[k];
    say(list + rest);
  }

  void cards() {
    std::vector<std::string> unknown;
    for (const InpDeck::Other& other : queue.others) {
      const InpCard& card = other.card;
      const Meaning what = meaning(card);
      if (what == Meaning::part) reject_part(card);
      if (what == Meaning::model && card.keyword.ends_with("SECTION")) section(other);
      if (what != Meaning::none && what != Meaning::model) seen_once(what, "*" + card.keyword, card.place);
      if (!known(card) && named.insert("*" + card.keyword).second) unknown.push_back("*" + card.keyword + " (" + where(card.place) + ")");
    }
    tell(Meaning::load, " of the file: supports and loads are ignored; those of the scene apply");
    tell(Meaning::law, " of the file: ignored; the body is linear elastic, with the damping of the scene");
    tell(Meaning::axes, " of the file: ignored; the axes of an orthotropic material are set in the scene (`angle`)");
    tell(Meaning::contact, " of the file: contact is ignored; define it in the scene");
    tell(Meaning::spider,
         " of the file: ignored, so the rim stays free; couple it with a point in the scene, {hole: NAME, coupling: rigid}");
    for (const std::string& keyword : unknown) say(keyword + " is unknown and ignored; check whether it changes the body");
  }

  std::vector<std::string> name_{};
};

}  // namespace

InpClaims inp_claims(const InpDeck& queue, const InpElements& elements) {
  Reading reading(queue, elements);
  reading.strain();
  reading.cards();
  reading.materials();
  reading.lines();
  return std::move(reading.claims);
}

}  // namespace pintle
