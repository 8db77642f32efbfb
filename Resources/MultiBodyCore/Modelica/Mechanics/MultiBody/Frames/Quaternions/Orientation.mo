within Modelica.Mechanics.MultiBody.Frames.Quaternions;
type Orientation "Quaternion: three components of the vector part, then the scalar part"
  extends Internal.QuaternionBase;

  encapsulated function equalityConstraint "Three residues that are zero when two quaternions mean the same orientation"
    import Modelica;
    import Modelica.Mechanics.MultiBody.Frames.Quaternions;
    extends Modelica.Icons.Function;
    input Quaternions.Orientation Q1 "First quaternion";
    input Quaternions.Orientation Q2 "Second quaternion";
    output Real residue[3] "tan(angle/2) times the axis of the rotation from Q1 to Q2";
  protected
    Real Q_rel[4] = Quaternions.relativeRotation(Q1, Q2) "Rotation from Q1 to Q2";
  algorithm
    residue := Q_rel[1:3]/Q_rel[4];
    annotation (Inline=true, Documentation(info="<html>
<p>The Rodrigues parameters of the rotation between the two: zero for <code>Q1 = Q2</code> and <code>Q1 = -Q2</code> only.</p></html>"));
  end equalityConstraint;
  annotation (Documentation(info="<html>
<p>Four numbers, of length 1: <code>Q[1:3] = e*sin(angle/2)</code>, <code>Q[4] = cos(angle/2)</code>.</p></html>"));
end Orientation;
