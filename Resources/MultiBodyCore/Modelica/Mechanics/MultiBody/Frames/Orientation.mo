within Modelica.Mechanics.MultiBody.Frames;
record Orientation "Orientation of a second frame with respect to a first one"
  extends Modelica.Icons.Record;
  Real T[3, 3] "Rotation matrix: coordinates in the first frame to coordinates in the second frame";
  SI.AngularVelocity w[3] "Angular velocity of the second frame with respect to the first, in coordinates of the second";

  encapsulated function equalityConstraint "Three residues that are zero when two orientations agree"
    import Modelica;
    import Modelica.Mechanics.MultiBody.Frames;
    extends Modelica.Icons.Function;
    input Frames.Orientation R1 "First orientation";
    input Frames.Orientation R2 "Second orientation";
    output Real residue[3] "tan(angle/2) times the axis of the rotation from R1 to R2";
  protected
    Real T_rel[3, 3] "Rotation from R1 to R2";
    Real c "Twice (1 + cosine of the angle of rotation)";
  algorithm
    T_rel := R2.T*transpose(R1.T);
    c := 1 + T_rel[1, 1] + T_rel[2, 2] + T_rel[3, 3];
    residue := {T_rel[2, 3] - T_rel[3, 2], T_rel[3, 1] - T_rel[1, 3], T_rel[1, 2] - T_rel[2, 1]}/c;
    annotation (Inline=true, Documentation(info="<html>
<p>Closes kinematic loops: a rotation has three degrees of freedom, so three numbers say whether two orientations agree.
They are the Rodrigues parameters <code>tan(angle/2)*axis</code> of the rotation between the two, which vanish for
agreeing orientations only and grow without bound towards half a turn, so that no loop closes the wrong way round.</p></html>"));
  end equalityConstraint;
  annotation (Documentation(info="<html>
<p>Orientation of a frame 2 with respect to a frame 1. <code>T</code> is orthogonal with determinant 1;
a vector with coordinates <code>v1</code> in frame 1 has coordinates <code>T*v1</code> in frame 2.
In the connectors of this library frame 1 is the world frame.</p></html>"));
end Orientation;
