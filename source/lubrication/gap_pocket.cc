#include "rectangular_gap.h"

namespace tribodraw
{
  namespace
  {
    class PocketGap : public RectangularGap
    {
    public:
      explicit PocketGap(Parameters &parameters) : RectangularGap(parameters)
      {
        const Range film = Range::positive().usual(1e-2, 1e4);
        land             = parameters.quantity("Land film", "um", film, "Gap before and behind the pocket.");
        pocket = parameters.quantity("Pocket film", "um", film, "Gap in the pocket.");
        start            = parameters.quantity("Pocket start", "mm", sides(), "Position x at which the pocket begins.");
        end              = parameters.quantity("Pocket end", "mm", sides(), "Position x at which the pocket ends.");
        if (!(start < end && end < l) && !parameters.documentation_mode())
          parameters.problem("Pocket end", "The pocket does not lie inside the bearing.",
                             "above `Pocket start`, less than `Length`");
      }
      double
      gap(const double x, double) const override
      {
        return x > start && x < end ? pocket : land;
      }
      std::vector<double>
      jumps() const override
      {
        return { start, end };
      }

    private:
      double land, pocket, start, end;
    };
  } // namespace

  TRIBODRAW_REGISTER(GapShape, PocketGap, "pocket", "A parallel gap with a pocket across.",
                     "J. Ausas, P. Ragot, J. Leiva, M. Jai, G. Bayada, G. C. Buscaglia, J. Tribol. 129 (2007) 868-875")
} // namespace tribodraw
