within ContactMultiBody.Friction;
package Internal "How the points of a patch share its anchor"
  extends Modelica.Icons.InternalPackage;

  annotation (Documentation(info="<html>
<p>
The two maps between what a patch has as a whole and what its points have. One is the transpose of the other, so that force times velocity is the same on both sides.
</p>
</html>"));
end Internal;
