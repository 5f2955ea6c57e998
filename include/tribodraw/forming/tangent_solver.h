#ifndef tribodraw_forming_tangent_solver_h
#define tribodraw_forming_tangent_solver_h

#include <tribodraw/contact/contact.h>

#include <vector>

namespace tribodraw
{
  /// Solves with the tangents of a Newton iteration. The factors of one tangent are kept as the preconditioner of GMRES
  /// (Saad and Schultz 1986) for a similar one that follows.
  class TangentSolver
  {
  public:
    TangentSolver();

    /// Replace @p b by the solution of tangent x = b for the unknowns that are not @p held (all of the sheet, then the
    /// free tools); the held ones become zero. @p similar says that the tangent is close to the last one: then its factors
    /// may serve, and the residual of the solution is below @p tolerance times b.
    /// @p tangent loses the rows and columns of the held unknowns.
    /// Returns false if the tangent is singular.
    bool solve(Contact::Tangent &tangent, const std::vector<bool> &held, double tolerance, bool similar, Eigen::VectorXd &b);
  private:
    bool            factor(const Contact::Tangent &tangent, const std::vector<bool> &held);
    Eigen::VectorXd multiply(const Contact::Tangent &tangent, const Eigen::VectorXd &x) const;
    Eigen::VectorXd precondition(const Eigen::VectorXd &b);
    bool            iterate(const Contact::Tangent &tangent, double tolerance, Eigen::VectorXd &b);

    DirectSolver    direct;
    bool            has_factors = false;
    bool            tools_held  = false;
    Eigen::MatrixXd by_travel, row, schur; ///< factored tangent: solution for the columns of the free tools; its border
  };
} // namespace tribodraw

#endif
