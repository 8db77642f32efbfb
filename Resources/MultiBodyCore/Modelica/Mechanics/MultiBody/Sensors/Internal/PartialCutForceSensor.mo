within Modelica.Mechanics.MultiBody.Sensors.Internal;
partial model PartialCutForceSensor "Sensor of what passes between two frames"
  extends Modelica.Icons.RoundSensor;
  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame_a "Frame on the one side of the cut"
    annotation (Placement(transformation(extent={{-116,-16},{-84,16}})));
  Modelica.Mechanics.MultiBody.Interfaces.Frame_b frame_b "Frame on the other side of the cut"
    annotation (Placement(transformation(extent={{84,-16},{116,16}})));
  Modelica.Mechanics.MultiBody.Interfaces.Frame_resolve frame_resolve
    if resolveInFrame == Modelica.Mechanics.MultiBody.Types.ResolveInFrameA.frame_resolve "Frame the output is resolved in"
    annotation (Placement(transformation(extent={{64,-116},{96,-84}})));
  parameter Modelica.Mechanics.MultiBody.Types.ResolveInFrameA resolveInFrame=
    Modelica.Mechanics.MultiBody.Types.ResolveInFrameA.frame_a "Frame the output is resolved in";
protected
  outer Modelica.Mechanics.MultiBody.World world;
  Cut cut "What is measured passes through here";
equation
  connect(frame_a, cut.frame_a);
  connect(cut.frame_b, frame_b);
  annotation (Documentation(info="<html><p>Base class of sensors of cut forces and torques. The two frames coincide.</p></html>"));
end PartialCutForceSensor;
