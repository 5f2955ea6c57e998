#ifndef tribodraw_tests_unit_forming_coarse_cup_h
#define tribodraw_tests_unit_forming_coarse_cup_h

#include "unit/forming/square_cup.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/forming/constant_friction.h>
#include <tribodraw/forming/simulation.h>

#include <memory>
#include <string>
#include <vector>

namespace tribodraw
{
  struct Records : Observer
  {
    std::vector<IncrementRecord> all;
    bool                         ended = false, converged = false;
    void committed(const Simulation &, const IncrementRecord &r) override { all.push_back(r); }
    void finished(const Simulation &, const bool ok) override
    {
      ended     = true;
      converged = ok;
    }
  };

  template <class Read>
  auto read_section(Parameters &p, const char *name, const Read &read)
  {
    const auto scope = p.section(name);
    return read(p);
  }

  /// A run of the forming sections of a parameter file.
  struct FormingRun
  {
    std::unique_ptr<Simulation> simulation;
    std::shared_ptr<Records>    records = std::make_shared<Records>();

    explicit FormingRun(Parameters p, std::unique_ptr<FrictionCoupling> friction = std::make_unique<ConstantFriction>(0.1))
    {
      const auto blank    = read_section(p, "Blank", Blank::read);
      const auto material = std::make_shared<SheetMaterial>(read_section(p, "Sheet material", SheetMaterial::read));
      const auto tools    = read_section(p, "Tools", ToolSet::read);
      const auto process  = read_section(p, "Process", Process::read);
      const auto settings = read_section(p, "Solver", SolverSettings::read);
      p.finish();
      simulation = std::make_unique<Simulation>(blank, material, tools, process, settings, std::move(friction));
      simulation->add_observer(records);
    }

    const IncrementRecord &last() const { return records->all.back(); }
  };

  /// The square cup coarse, short and isotropic, so that x and y must agree; @p changes come last and win.
  inline Parameters coarse_cup(const std::vector<std::string> &changes = {})
  {
    std::vector<std::string> all = {"Blank/Element size = 9.375 mm", "Sheet material/Yield locus = von Mises", "Process/Punch travel = 6 mm"};
    all.insert(all.end(), changes.begin(), changes.end());
    return Parameters::from_text(square_cup, "cup", all);
  }

  /// What check_process() and the reading of the forming sections find; empty: nothing.
  inline std::string problems_of(Parameters p)
  {
    try
      {
        const auto blank = read_section(p, "Blank", Blank::read);
        read_section(p, "Sheet material", SheetMaterial::read);
        const auto tools   = read_section(p, "Tools", ToolSet::read);
        const auto process = read_section(p, "Process", Process::read);
        check_process(p, blank, tools, process);
        p.finish();
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "";
  }
} // namespace tribodraw

#endif
