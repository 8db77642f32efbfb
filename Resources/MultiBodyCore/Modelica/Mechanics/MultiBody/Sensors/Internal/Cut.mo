within Modelica.Mechanics.MultiBody.Sensors.Internal;
model Cut "Two frames that coincide"
  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame_a "Frame on the one side"
    annotation (Placement(transformation(extent={{-116,-16},{-84,16}})));
  Modelica.Mechanics.MultiBody.Interfaces.Frame_b frame_b "Frame on the other side"
    annotation (Placement(transformation(extent={{84,-16},{116,16}})));
equation
  Connections.branch(frame_a.R, frame_b.R);
  frame_b.r_0 = frame_a.r_0;
  frame_b.R = frame_a.R;
  zeros(3) = frame_a.f + frame_b.f;
  zeros(3) = frame_a.t + frame_b.t;
  annotation (Documentation(info="<html><p>Passes everything on.</p></html>"));
end Cut;
