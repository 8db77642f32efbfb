within ContactMultiBody.Internal.Restitution;
pure function inverseTensors "Inverses of tensors of inertia"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Inertia I[:, 3, 3] "Tensors of inertia";
  output Real inverse[size(I, 1), 3, 3](each unit="1/(kg.m2)") "Their inverses; 0 for bodies that cannot turn";
protected
  Real adjoint[3, 3](each unit="kg2.m4") "Adjoint of a tensor";
  Real determinant(unit="kg3.m6") "Determinant of a tensor";
algorithm
  for i in 1:size(I, 1) loop
    adjoint := {cross(I[i, :, 2], I[i, :, 3]),cross(I[i, :, 3], I[i, :, 1]),cross(I[i, :, 1], I[i, :, 2])};
    determinant := I[i, :, 1]*adjoint[1, :];
    inverse[i, :, :] := if determinant > 0 then adjoint/determinant else zeros(3, 3);
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>
By cross products of the columns. A tensor without determinant is that of a point mass or of a rod, whose resistance
against turning is not known: it counts as infinite.
</p>
</html>"));
end inverseTensors;
