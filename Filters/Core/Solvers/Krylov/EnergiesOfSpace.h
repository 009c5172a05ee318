#ifndef dmgEnergiesOfSpace_h
#define dmgEnergiesOfSpace_h

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace dmg
{

/// Energies of the fields in a space of few dimensions. Where fewer of them are prescribed than there are,
/// some have none but rounding errors.
class EnergiesOfSpace
{
public:
  /// \param H a basis, a field per column.
  /// \param energies H^T A H.
  /// \param largest what the energies would be if nothing cancelled.
  EnergiesOfSpace(const Eigen::MatrixXd& H, const Eigen::MatrixXd& energies, double largest);

  /// (H^T A H)^-1 where there is energy, 0 elsewhere.
  const Eigen::MatrixXd& Inverse() const { return this->InverseEnergies; }
  /// An orthonormal basis of the fields without energy.
  const Eigen::MatrixXd& Undetermined() const { return this->Kernel; }

private:
  Eigen::MatrixXd InverseEnergies;
  Eigen::MatrixXd Kernel;
};

}

#endif
